#include "facemodel/nearest_surface.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

namespace viaface {

using Eigen::Vector3d;

Vector3d nearest_shares(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const Vector3d bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    const Vector3d cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    const double sum = va + vb + vc;
    if (!(sum > 0)) return {1, 0, 0};
    return {1 - (vb + vc) / sum, vb / sum, vc / sum};
}

Nodes node_normals(const Nodes& nodes, const std::vector<Triangle>& triangles) {
    Nodes normals = Nodes::Zero(nodes.rows(), 3);
    for (const Triangle& t : triangles) {
        const Vector3d a = nodes.row(t[0]), b = nodes.row(t[1]), c = nodes.row(t[2]);
        const Vector3d area = (b - a).cross(c - a);
        for (const int node : t) normals.row(node) += area.transpose();
    }
    for (Eigen::Index i = 0; i < normals.rows(); ++i) normals.row(i).normalize();
    return normals;
}

NearestSurface::NearestSurface(const Nodes& nodes, const std::vector<Triangle>& triangles)
    : nodes_(nodes),
      triangles_(triangles),
      order_(triangles.size()),
      normals_(node_normals(nodes, triangles)) {
    if (triangles.empty()) throw std::invalid_argument("a surface without triangles");
    std::iota(order_.begin(), order_.end(), 0);
    build(0, static_cast<int>(order_.size()));
    std::map<std::pair<int, int>, int> uses;
    const auto edge = [](const Triangle& t, int k) { return std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]); };
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) ++uses[edge(t, k)];
    }
    border_.resize(triangles.size());
    border_nodes_.resize(static_cast<std::size_t>(nodes.rows()));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            border_[i][k] = uses[edge(triangles[i], k)] == 1;
            if (!border_[i][k]) continue;
            for (const int end : {1, 2})
                border_nodes_[static_cast<std::size_t>(triangles[i][(k + end) % 3])] = true;
        }
    }
}

int NearestSurface::build(int first, int count) {
    constexpr int kLeaf = 6;
    const int index = static_cast<int>(boxes_.size());
    boxes_.emplace_back();
    Eigen::AlignedBox3d bounds, middles;
    const auto middle = [&](int t) -> Vector3d {
        return (nodes_.row(triangles_[t][0]) + nodes_.row(triangles_[t][1]) + nodes_.row(triangles_[t][2])) /
               3;
    };
    for (int k = first; k < first + count; ++k) {
        for (const int node : triangles_[order_[k]]) bounds.extend(nodes_.row(node).transpose());
        middles.extend(middle(order_[k]));
    }
    boxes_[index].bounds = bounds;
    if (count <= kLeaf) {
        boxes_[index].first = first;
        boxes_[index].count = count;
        return index;
    }
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
        const double at_a = middle(a)[axis], at_b = middle(b)[axis];
        return at_a != at_b ? at_a < at_b : a < b;
    });
    build(first, count / 2);
    const int right = build(first + count / 2, count - count / 2);
    boxes_[index].right = right;
    return index;
}

void NearestSurface::search(int index, const Vector3d& place, SurfacePlace& best) const {
    const Box& box = boxes_[index];
    if (box.bounds.squaredExteriorDistance(place) >= best.distance) return;
    for (int k = box.first; k < box.first + box.count; ++k) {
        const Triangle& t = triangles_[order_[k]];
        const Vector3d a = nodes_.row(t[0]), b = nodes_.row(t[1]), c = nodes_.row(t[2]);
        const Vector3d shares = nearest_shares(place, a, b, c);
        const Vector3d at = shares[0] * a + shares[1] * b + shares[2] * c;
        const double distance = (at - place).squaredNorm();
        if (distance < best.distance) best = {order_[k], shares, at, distance};
    }
    if (box.count > 0) return;
    int near = index + 1, far = box.right;
    if (boxes_[far].bounds.squaredExteriorDistance(place) <
        boxes_[near].bounds.squaredExteriorDistance(place))
        std::swap(near, far);
    search(near, place, best);
    search(far, place, best);
}

SurfacePlace NearestSurface::operator()(const Vector3d& place, double within) const {
    SurfacePlace best;
    best.distance = within * within;
    search(0, place, best);
    best.distance = std::sqrt(best.distance);
    return best;
}

Vector3d NearestSurface::normal(const SurfacePlace& at) const {
    Vector3d normal = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) normal += at.shares[k] * normals_.row(triangles_[at.triangle][k]).transpose();
    return normal.normalized();
}

bool NearestSurface::on_border(const SurfacePlace& at) const {
    for (int k = 0; k < 3; ++k) {
        if (at.shares[k] < 1e-9 && border_[at.triangle][k]) return true;
        if (at.shares[k] > 1 - 1e-9 && border_nodes_[triangles_[at.triangle][k]]) return true;
    }
    return false;
}

}  // namespace viaface
