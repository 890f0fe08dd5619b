#include "synth/pose/seats.hpp"

#include <algorithm>
#include <array>

namespace viaface {
namespace {

using Eigen::Vector3d;

// Weights of the nearest place of a triangle (Ericson's regions, by projection and clamping to the edges).
Vector3d nearest_weights(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
    const Vector3d u = b - a, v = c - a, w = p - a;
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
    const double area = uu * vv - uv * uv;
    if (area > 0) {
        const double s = (wu * vv - wv * uv) / area, t = (wv * uu - wu * uv) / area;
        if (s >= 0 && t >= 0 && s + t <= 1) return {1 - s - t, s, t};
    }
    const auto on_edge = [&](const Vector3d& from, const Vector3d& to) {
        return std::clamp((p - from).dot(to - from) / std::max((to - from).squaredNorm(), 1e-12), 0.0, 1.0);
    };
    const double ab = on_edge(a, b), bc = on_edge(b, c), ca = on_edge(c, a);
    const std::array<Vector3d, 3> candidates = {Vector3d(1 - ab, ab, 0), Vector3d(0, 1 - bc, bc),
                                                Vector3d(ca, 0, 1 - ca)};
    return *std::min_element(candidates.begin(), candidates.end(), [&](const Vector3d& k, const Vector3d& l) {
        return (k[0] * a + k[1] * b + k[2] * c - p).norm() < (l[0] * a + l[1] * b + l[2] * c - p).norm();
    });
}

}  // namespace

Vector3d Seat::at(const Nodes& mesh) const {
    return weights[0] * mesh.row(nodes[0]).transpose() + weights[1] * mesh.row(nodes[1]).transpose() +
           weights[2] * mesh.row(nodes[2]).transpose() + step;
}

Seat seat_on(const Nodes& mesh, const std::vector<Triangle>& triangles, const Vector3d& place) {
    Seat best;
    double least = 1e300;
    for (const Triangle& t : triangles) {
        const Vector3d a = mesh.row(t[0]), b = mesh.row(t[1]), c = mesh.row(t[2]);
        const Seat seat{t, nearest_weights(a, b, c, place), Vector3d::Zero()};
        const double distance = (seat.at(mesh) - place).norm();
        if (distance >= least) continue;
        least = distance;
        best = seat;
    }
    best.step = place - best.at(mesh);
    return best;
}

std::vector<Triangle> ring_of(const LipGrid& lips, int row) {
    std::vector<Triangle> ring;
    for (int c = 0; c < LipGrid::kColumns; ++c)
        ring.push_back({lips.node(row, c), lips.node(row, c + 1), lips.node(row, c)});
    return ring;
}

double column_of(const Seat& seat, const LipGrid& lips, int row) {
    const int column = seat.nodes[0] - lips.node(row, 0);
    return column + seat.weights[1];
}

}  // namespace viaface
