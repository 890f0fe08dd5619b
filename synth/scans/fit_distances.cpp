#include "synth/scans/fit_distances.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Vector3d;

constexpr double kWithinFace = 0.5;  // of face_share
constexpr double kRoundLips = 6;     // mm
constexpr int kSeenRows = 10;        // of the lips

bool inside_mouth(const LipGrid& lips, int node) {
    return node >= lips.node(kSeenRows, 0) && node < lips.node(LipGrid::kRows, 0);
}

double from_lips(const GenericHead& generic, const Nodes& nodes, const Vector3d& place) {
    double nearest = 1e9;
    for (int row = 0; row < kSeenRows; row += 3) {
        for (int c = 0; c < LipGrid::kColumns; ++c) {
            const int node =
                row == 0 ? generic.lip_border[static_cast<std::size_t>(c)] : generic.face.lips.node(row, c);
            nearest = std::min(nearest, (nodes.row(node).transpose() - place).norm());
        }
    }
    return nearest;
}

}  // namespace

FitDistances distances_of(std::vector<double> values) {
    FitDistances d;
    d.samples = values.size();
    if (values.empty()) return d;
    std::ranges::sort(values);
    for (const double v : values) d.mean += v / static_cast<double>(values.size());
    d.p95 = values[values.size() * 95 / 100];
    d.largest = values.back();
    return d;
}

namespace {

std::vector<Triangle> seen_face(const GenericHead& generic) {
    const Eigen::VectorXd share = generic.face_share();
    const auto open = seen_nodes(generic.face.rest, generic.surface);
    std::vector<Triangle> face;
    for (const Triangle& t : generic.surface) {
        const bool within = std::ranges::all_of(t, [&](int node) { return share[node] > kWithinFace; });
        const bool hidden = std::ranges::any_of(t, [&](int node) {
            return inside_mouth(generic.face.lips, node) || !open[static_cast<std::size_t>(node)];
        });
        if (within && !hidden) face.push_back(t);
    }
    return face;
}

}  // namespace

std::vector<bool> seen_nodes(const Nodes& nodes, const std::vector<Triangle>& triangles) {
    constexpr double kTurn = std::numbers::pi / 4, kDeep = 1.0;  // mm
    std::vector<bool> seen(static_cast<std::size_t>(nodes.rows()));
    for (const auto& [yaw, tilt] :
         {std::pair{0.0, 0.0}, {kTurn, 0.0}, {-kTurn, 0.0}, {0.0, kTurn}, {0.0, -kTurn}}) {
        const Eigen::Matrix3d turn =
            (Eigen::AngleAxisd(yaw, Vector3d::UnitY()) * Eigen::AngleAxisd(tilt, Vector3d::UnitX()))
                .toRotationMatrix();
        PaintedSurface turned;
        turned.mesh.nodes = nodes * turn.transpose();
        turned.mesh.triangles = triangles;
        const PaintedSurface* surfaces[] = {&turned};
        const SurfaceView view = look(surfaces, {-150, 200, 2, 600, 700});
        for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
            const Vector3d p = turned.mesh.nodes.row(i);
            // What no picture shows beside the node does not hide it.
            if (!(p.z() < view.depth_at(p.x(), p.y()) - kDeep)) seen[static_cast<std::size_t>(i)] = true;
        }
    }
    return seen;
}

std::vector<Triangle> turned_triangles(const GenericHead& generic, const Nodes& nodes) {
    const auto normal = [](const Nodes& at, const Triangle& t) -> Vector3d {
        const Vector3d a = at.row(t[0]), b = at.row(t[1]), c = at.row(t[2]);
        return (b - a).cross(c - a);
    };
    std::vector<Triangle> turned;
    for (const Triangle& t : seen_face(generic)) {
        if (normal(nodes, t).dot(normal(generic.face.rest, t)) < 0) turned.push_back(t);
    }
    return turned;
}

namespace {

// Nodes that a triangle has: not those of scraps that were left out.
std::vector<bool> joined_nodes(const ScanMesh& mesh) {
    std::vector<bool> joined(static_cast<std::size_t>(mesh.nodes.rows()));
    for (const Triangle& t : mesh.triangles) {
        for (const int node : t) joined[static_cast<std::size_t>(node)] = true;
    }
    return joined;
}

}  // namespace

void measure_fit(const GenericHead& generic, const NearestSurface& scan, AdaptedHead& head) {
    const auto open = seen_nodes(head.nodes, generic.surface);
    std::vector<Triangle> face = seen_face(generic);
    std::erase_if(face, [&](const Triangle& t) {
        return !std::ranges::all_of(t, [&](int node) { return open[static_cast<std::size_t>(node)]; });
    });
    std::vector<double> to_scan, from_surface, lips_to, lips_from;
    const auto add = [&](const Vector3d& place, double distance, std::vector<double>& all,
                         std::vector<double>& lips) {
        all.push_back(distance * head.mm_per_generic);
        if (from_lips(generic, head.nodes, place) < kRoundLips) lips.push_back(all.back());
    };
    for (const Triangle& t : face) {
        const Vector3d a = head.nodes.row(t[0]), b = head.nodes.row(t[1]), c = head.nodes.row(t[2]);
        for (const Vector3d& place : {Vector3d((a + b + c) / 3), a}) {
            const SurfacePlace near = scan(place);
            if (!scan.on_border(near)) add(place, near.distance, to_scan, lips_to);
        }
    }
    const Eigen::VectorXd share = generic.face_share();
    std::vector<Triangle> whole = generic.surface;  // the lips' inside too, and the eyes
    std::erase_if(whole, [&](const Triangle& t) {
        return std::ranges::any_of(t, [&](int node) { return share[node] <= kWithinFace; });
    });
    for (const char* eye : {"eye_left", "eye_right"}) {
        const auto& ball = part_named(generic.face, eye).triangles;
        whole.insert(whole.end(), ball.begin(), ball.end());
    }
    const Nodes with_eyes = eyes_seated(generic, head.nodes);
    const NearestSurface drawn(with_eyes, whole);
    const std::vector<bool> seen = seen_nodes(head.scan.mesh.nodes, head.scan.mesh.triangles);
    const std::vector<bool> joined = joined_nodes(head.scan.mesh);
    for (Eigen::Index i = 0; i < head.scan.mesh.nodes.rows(); ++i) {
        const Vector3d place = head.scan.mesh.nodes.row(i);
        if (!seen[static_cast<std::size_t>(i)] || !joined[static_cast<std::size_t>(i)]) continue;
        const SurfacePlace near = drawn(place);
        if (near.distance < 20 && !drawn.on_border(near)) add(place, near.distance, from_surface, lips_from);
    }
    head.flipped = static_cast<int>(turned_triangles(generic, head.nodes).size());
    head.to_scan = distances_of(std::move(to_scan));
    head.from_surface = distances_of(std::move(from_surface));
    head.lips_to_scan = distances_of(std::move(lips_to));
    head.lips_from_surface = distances_of(std::move(lips_from));
}

}  // namespace viaface
