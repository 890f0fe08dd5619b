#include "synth/training/teeth.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Vector3d;
constexpr int kSections = 4, kAround = 10, kPerSide = 7, kNodesPerTooth = kSections * kAround + 1;

// One crown: where its middle stands (mm), which way it faces (degrees from straight ahead), how wide it is
// along the arch and deep across it, its edge's height, how thin its edge is (part of its depth) and how
// pointed.
struct Crown {
    double x, z, facing, width, depth, edge, thin, point;
};
constexpr std::array<Crown, kPerSide> kUpper = {{{4.1, -1.9, 6, 8.3, 6.6, 0.0, 0.28, 0.0},
                                                 {11.4, -4.0, 24, 6.7, 6.0, 0.7, 0.28, 0.1},
                                                 {17.0, -9.6, 50, 7.4, 7.0, 0.3, 0.35, 0.9},
                                                 {20.3, -16.8, 70, 6.8, 8.6, 0.9, 0.75, 0.5},
                                                 {22.4, -23.8, 76, 6.7, 8.8, 1.3, 0.75, 0.4},
                                                 {24.2, -32.0, 80, 9.6, 10, 1.7, 0.85, 0.2},
                                                 {25.8, -41.4, 82, 9.2, 10, 2.8, 0.85, 0.2}}};
constexpr std::array<Crown, kPerSide> kLower = {{{2.8, -3.9, 4, 5.5, 5.8, 0.3, 0.28, 0.0},
                                                 {8.2, -5.2, 20, 5.7, 5.8, 0.5, 0.28, 0.1},
                                                 {13.6, -9.6, 45, 6.6, 6.6, 0.9, 0.35, 0.8},
                                                 {17.4, -16.0, 64, 6.8, 7.4, 0.5, 0.7, 0.5},
                                                 {19.8, -23.0, 74, 6.9, 7.8, 0.5, 0.75, 0.4},
                                                 {22.0, -31.6, 79, 10.2, 9, 0.9, 0.85, 0.2},
                                                 {23.8, -41.6, 82, 9.8, 9, 2.0, 0.85, 0.2}}};
constexpr double kCrownHeight = 11.5;  // mm, from the edge to a neck within the gum

double signed_power(double v, double e) { return std::copysign(std::pow(std::abs(v), e), v); }

// Sections from the neck (0) to the edge (kSections - 1), then the middle of the biting face.
void add_crown(PartMesh& part, int first, const Crown& crown, double mirror, double side, double shade) {
    const double facing = crown.facing * std::numbers::pi / 180;
    const Vector3d out(mirror * std::sin(facing), 0, std::cos(facing));
    const Vector3d along(mirror * std::cos(facing), 0, -std::sin(facing));
    const Vector3d middle(mirror * crown.x, crown.edge, crown.z);
    constexpr std::array<double, kSections> kHeights = {0, 0.5, 0.92, 1};
    constexpr std::array<double, kSections> kWidths = {0.76, 0.97, 0.98, 0.84};
    for (int s = 0; s < kSections; ++s) {
        const double h = kHeights[static_cast<std::size_t>(s)];
        const double edge_part = std::pow(h, 1.4);
        const double depth =
            crown.depth * ((1 - edge_part) + edge_part * crown.thin) * (s == kSections - 1 ? 0.8 : 1);
        const double front =
            crown.depth * 0.5 * (1 - 0.10 * h * h);  // the face leans back a little at the edge
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2 * std::numbers::pi * k / kAround;
            const double across = signed_power(std::cos(angle), 0.6),
                         sideways = signed_power(std::sin(angle), 0.7);
            const double width = crown.width * kWidths[static_cast<std::size_t>(s)];
            const double lift = crown.point * 1.6 * sideways * sideways * h * h;
            const double bow = 0.10 * crown.width * sideways * sideways;  // a face is round from side to side
            const Vector3d place = middle + out * (front - depth * (0.5 - 0.5 * across) - bow) +
                                   along * (0.5 * width * sideways) +
                                   Vector3d(0, side * (kCrownHeight * (1 - h) + lift), 0);
            const int node = first + s * kAround + k;
            part.nodes.row(node) = place.transpose();
            part.uvs.row(node) << static_cast<float>(shade + 0.05 * k / kAround), static_cast<float>(h);
        }
    }
    const int cap = first + kSections * kAround;
    const double inset = crown.depth * 0.5 * (0.9 - crown.thin * 0.8);
    part.nodes.row(cap) = (middle + out * inset + Vector3d(0, side * 0.05, 0)).transpose();
    part.uvs.row(cap) << static_cast<float>(shade + 0.025), 1.0f;
    const bool flipped = mirror * side > 0;
    const auto add = [&](int a, int b, int c) {
        part.triangles.push_back(flipped ? Triangle{a, c, b} : Triangle{a, b, c});
    };
    const auto node = [&](int s, int k) { return first + s * kAround + k % kAround; };
    for (int k = 0; k < kAround; ++k) {
        for (int s = 0; s + 1 < kSections; ++s) {
            add(node(s, k), node(s + 1, k + 1), node(s + 1, k));
            add(node(s, k), node(s, k + 1), node(s + 1, k + 1));
        }
        add(node(kSections - 1, k), node(kSections - 1, k + 1), cap);
    }
}

PartMesh teeth(const std::array<Crown, kPerSide>& arch, double side, std::string name, Drive drive) {
    PartMesh part{std::move(name),
                  Material::kTeeth,
                  drive,
                  Nodes(2 * kPerSide * kNodesPerTooth, 3),
                  Uvs(2 * kPerSide * kNodesPerTooth, 2),
                  {}};
    for (int i = 0; i < 2 * kPerSide; ++i) {
        const double mirror = i < kPerSide ? 1 : -1;
        add_crown(part, i * kNodesPerTooth, arch[static_cast<std::size_t>(i % kPerSide)], mirror, side,
                  i / 16.0);
    }
    return part;
}

// The arch as a curve: 0 at the right end, 1 at the left, through the crowns' middles.
Crown on_arch(const std::array<Crown, kPerSide>& arch, double t) {
    const double place = t * (2 * kPerSide - 1);
    const int k = std::min(static_cast<int>(place), 2 * kPerSide - 2);
    const auto crown = [&](int i) {
        Crown c = arch[static_cast<std::size_t>(i < kPerSide ? kPerSide - 1 - i : i - kPerSide)];
        if (i < kPerSide) {
            c.x = -c.x;
            c.facing = -c.facing;
        }
        return c;
    };
    const Crown a = crown(k), b = crown(k + 1);
    const double s = place - k, r = 1 - s;
    return {r * a.x + s * b.x,
            r * a.z + s * b.z,
            r * a.facing + s * b.facing,
            0,
            r * a.depth + s * b.depth,
            r * a.edge + s * b.edge,
            0,
            0};
}

PartMesh gums(const std::array<Crown, kPerSide>& arch, double side, std::string name, Drive drive) {
    constexpr int kSteps = 40, kAcross = 8;
    // Across the ridge, from the lip's side to the tongue's: outwards of the crown's faces, above the edge,
    // mm. The last two close the roof or leave the floor open, as parts of the way to the middle.
    struct Profile {
        double out, up;
    };
    constexpr std::array<Profile, 6> kProfile = {
        {{0.5, 22}, {1.5, 15}, {0.9, 10.6}, {-1.6, 9.2}, {-1, 9.6}, {-2.5, 13}}};
    PartMesh part{
        std::move(name), Material::kGums, drive, Nodes(kSteps * kAcross, 3), Uvs(kSteps * kAcross, 2), {}};
    for (int i = 0; i < kSteps; ++i) {
        const double t = static_cast<double>(i) / (kSteps - 1);
        const Crown crown = on_arch(arch, t);
        const double facing = crown.facing * std::numbers::pi / 180;
        const Vector3d out(std::sin(facing), 0, std::cos(facing)), middle(crown.x, crown.edge, crown.z);
        const double papilla = 0.9 * (0.5 - 0.5 * std::cos(2 * std::numbers::pi * t * (2 * kPerSide - 1)));
        for (int k = 0; k < kAcross; ++k) {
            Vector3d place;
            if (k < 6) {
                const auto [outward, up] = kProfile[static_cast<std::size_t>(k)];
                const double half = k < 4 ? crown.depth / 2 : -crown.depth / 2;
                const double fold = k == 2 || k == 3 ? papilla : 0;
                place = middle + out * (half + outward) + Vector3d(0, side * (up - fold), 0);
            } else {
                const double inwards = k == 6 ? 0.45 : 0.0;
                place = Vector3d(inwards * crown.x, side * (k == 6 ? 17.5 : 19.5), crown.z - 6);
            }
            part.nodes.row(i * kAcross + k) = place.transpose();
            part.uvs.row(i * kAcross + k) << static_cast<float>(t), static_cast<float>(k) / (kAcross - 1);
        }
    }
    for (int i = 0; i + 1 < kSteps; ++i) {
        for (int k = 0; k + 1 < kAcross; ++k) {
            const int a = i * kAcross + k, b = a + kAcross, c = b + 1, d = a + 1;
            part.triangles.push_back(side > 0 ? Triangle{a, d, c} : Triangle{a, c, d});
            part.triangles.push_back(side > 0 ? Triangle{a, c, b} : Triangle{a, b, c});
        }
    }
    return part;
}

}  // namespace

PartMesh upper_teeth() { return teeth(kUpper, +1, "teeth_upper", Drive::kFixed); }
PartMesh lower_teeth() { return teeth(kLower, -1, "teeth_lower", Drive::kJaw); }
PartMesh upper_gums() { return gums(kUpper, +1, "gums_upper", Drive::kFixed); }
PartMesh lower_gums() { return gums(kLower, -1, "gums_lower", Drive::kJaw); }

TeethFront upper_front() { return {1.6, 0.026, 0.0, +1, 2.0}; }
TeethFront lower_front() { return {-0.9, 0.030, 0.3, -1, 2.0}; }

}  // namespace viaface
