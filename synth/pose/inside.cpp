#include "synth/pose/inside.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Vector3d;

double smooth(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// The rings behind the lips: half width, height above and below, the z of their middle, how fast z falls off
// with x^2, how much they follow the inner contour.
struct Ring {
    double half_width, above, below, z, fall, follow;
};
constexpr std::array<Ring, MouthLining::kRings> kLiningRings = {{{0, 0, 0, 0, 0, 1},
                                                                 {0, 0, 0, 0, 0, 0.97},
                                                                 {0, 0, 0, 0, 0, 0.85},
                                                                 {24.5, 8, 10, 2.6, 0.020, 0.5},
                                                                 {28, 15, 14, 1.6, 0.020, 0.15},
                                                                 {32, 21, 17, -22, 0.004, 0.03},
                                                                 {33, 25, 19, -45, 0, 0},
                                                                 {27, 24, 19, -68, 0, 0},
                                                                 {14, 18, 15, -84, 0, 0}}};

double angle_of(int column) { return std::numbers::pi * (0.5 - 2.0 * column / MouthLining::kColumns); }

// Behind parted lips the lining turns away from the opening, so that lips end in their own red.
Vector3d turned_in(int ring, int column, double gap) {
    constexpr double kStillShut = 0.8, kParted = 2.5, kAway = 1.3, kBack = 0.5;  // mm
    if (ring != 1 && ring != 2) return Vector3d::Zero();
    const double open = smooth((gap - kStillShut) / kParted);
    return open * Vector3d(0, kAway * std::sin(angle_of(column)), -kBack);
}

Vector3d on_ring(const Ring& ring, int column) {
    const double x = ring.half_width * std::cos(angle_of(column)), s = std::sin(angle_of(column));
    return {x, (s > 0 ? ring.above : ring.below) * s, ring.z - ring.fall * x * x};
}

// The part of the jaw's motion that a column takes: none above, all below.
double jaw_share(int column) { return smooth(0.5 - 0.75 * std::sin(angle_of(column))); }

// The tongue's outline along its length t: 0 at the tip, 1 at the root.
struct TongueSection {
    double z, top, bottom, half_width;
};
TongueSection tongue_section(double t) {
    const double z = -10 - 66 * t;
    const double top = -2.6 + 7.5 * smooth(t / 0.55) - 16 * smooth((t - 0.68) / 0.4);
    const double bottom = -6.0 - 9 * smooth(t / 0.35) - 8 * smooth((t - 0.6) / 0.4);
    const double width = 18.5 * std::sqrt(std::clamp(1 - std::pow(1 - (t + 0.02) / 0.36, 2), 0.0, 1.0));
    return {z, top, bottom, t + 0.02 > 0.36 ? 18.5 : width};
}

}  // namespace

JawMotion jaw_motion(const Vector3d& hinge, const Vector3d& incisor_rest, const Vector3d& incisor) {
    const Vector3d from = incisor_rest - hinge, to = incisor - hinge;
    // About x, y turns into z.
    const double angle = std::atan2(to.z(), to.y()) - std::atan2(from.z(), from.y());
    JawMotion motion{hinge, Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(), Vector3d::Zero()};
    motion.shift = to - motion.turn * from;
    return motion;
}

Nodes MouthLining::rest(const Contour& inner) {
    Nodes nodes(kNodes, 3);
    for (int c = 0; c < kColumns; ++c) {
        const Vector3d edge = inner.row(c), behind = on_ring(kLiningRings[3], c);
        const double s = std::sin(angle_of(c));
        nodes.row(c) = edge;
        // Behind closed lips the lining of one reaches past the other's: no tooth shines through the seam.
        nodes.row(kColumns + c) = (edge + Vector3d(0, -0.25 * s, -1.2)).transpose();
        nodes.row(2 * kColumns + c) = (0.6 * edge + 0.4 * behind + Vector3d(0, 0, -0.8)).transpose();
        for (int r = 3; r < kRings; ++r) {
            nodes.row(r * kColumns + c) = on_ring(kLiningRings[static_cast<std::size_t>(r)], c).transpose();
        }
    }
    nodes.row(kNodes - 1) << 0, 0, -92;
    return nodes;
}

std::vector<Triangle> MouthLining::triangles(int first) {
    std::vector<Triangle> triangles;
    const auto node = [&](int r, int c) { return first + r * kColumns + c % kColumns; };
    for (int c = 0; c < kColumns; ++c) {
        for (int r = 0; r + 1 < kRings; ++r) {
            triangles.push_back({node(r, c), node(r + 1, c), node(r + 1, c + 1)});
            triangles.push_back({node(r, c), node(r + 1, c + 1), node(r, c + 1)});
        }
        triangles.push_back({node(kRings - 1, c), first + kNodes - 1, node(kRings - 1, c + 1)});
    }
    return triangles;
}

Nodes MouthLining::posed(const Nodes& rest, const Contour& inner, const JawMotion& jaw) {
    Nodes nodes = rest;
    for (int c = 0; c < kColumns; ++c) {
        const Vector3d edge = (inner.row(c) - rest.row(c)).transpose();
        const double below = jaw_share(c), gap = std::abs(inner(c, 1) - inner(facing_column(c), 1));
        for (int r = 0; r < kRings; ++r) {
            const double follow = kLiningRings[static_cast<std::size_t>(r)].follow;
            const Vector3d place = rest.row(r * kColumns + c);
            const Vector3d ride = follow * edge + (1 - follow) * below * (jaw(place) - place);
            nodes.row(r * kColumns + c) = (place + ride + turned_in(r, c, gap)).transpose();
        }
    }
    return nodes;
}

Nodes TongueSweep::rest() {
    Nodes nodes(kNodes, 3);
    for (int s = 0; s < kSections; ++s) {
        const double t = std::pow((s + 0.35) / (kSections - 1 + 0.35), 1.3);
        const TongueSection section = tongue_section(t);
        const double middle = (section.top + section.bottom) / 2, half = (section.top - section.bottom) / 2;
        for (int k = 0; k < kAround; ++k) {
            const double angle =
                2 * std::numbers::pi * k / kAround;  // from the top towards the talker's left
            const double x = std::sin(angle), y = std::cos(angle);
            const double groove = y > 0 ? 1.2 * std::exp(-std::pow(x / 0.3, 2)) * smooth(t / 0.3) : 0;
            nodes.row(s * kAround + k) << section.half_width * std::copysign(std::pow(std::abs(x), 0.8), x),
                middle + half * std::copysign(std::pow(std::abs(y), 0.7), y) - groove, section.z;
        }
    }
    nodes.row(kNodes - 2) << 0, -4.4, -9.2;
    nodes.row(kNodes - 1) << 0, -22, -78;
    return nodes;
}

std::vector<Triangle> TongueSweep::triangles(int first) {
    std::vector<Triangle> triangles;
    const auto node = [&](int s, int k) { return first + s * kAround + k % kAround; };
    for (int k = 0; k < kAround; ++k) {
        triangles.push_back({first + kNodes - 2, node(0, k + 1), node(0, k)});
        for (int s = 0; s + 1 < kSections; ++s) {
            triangles.push_back({node(s, k), node(s, k + 1), node(s + 1, k + 1)});
            triangles.push_back({node(s, k), node(s + 1, k + 1), node(s + 1, k)});
        }
        triangles.push_back({first + kNodes - 1, node(kSections - 1, k), node(kSections - 1, k + 1)});
    }
    return triangles;
}

Nodes TongueSweep::posed(const Nodes& rest, const std::array<Vector3d, 3>& points_rest,
                         const std::array<Vector3d, 3>& points, const JawMotion& jaw) {
    Nodes nodes = rest;
    const double tip = points_rest[0].z(), body = points_rest[1].z(), rear = points_rest[2].z();
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
        const Vector3d place = rest.row(i);
        const double z = place.z();
        const double of_tip = smooth((z - body) / (tip - body)), of_rear = smooth((body - z) / (body - rear));
        const double root = smooth((rear - z) / 20);
        const Vector3d ride = jaw(place) - place;
        Vector3d move = of_tip * (points[0] - points_rest[0]) +
                        (1 - of_tip - of_rear) * (points[1] - points_rest[1]) +
                        of_rear * (points[2] - points_rest[2]);
        move = (1 - 0.6 * root) * move;
        const double depth = smooth((-5 - place.y()) / 12) * (1 - of_tip);  // the tip is free of the floor
        nodes.row(i) = (place + (1 - depth) * move + depth * ride).transpose();
    }
    return nodes;
}

}  // namespace viaface
