#include "facemodel/delaunay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viaface {
namespace {

using Eigen::Vector2d;
using Edge = std::array<int, 2>;

// Left and right halves of a face put four points on a circle everywhere; the shift breaks every such tie.
Flat shifted(const Flat& points) {
    constexpr double kShift = 1e-6;
    Flat moved = points;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const double phase = 12.9898 * points(i, 0) + 78.233 * points(i, 1);
        moved.row(i) += kShift * Eigen::RowVector2d(std::sin(phase), std::cos(1.7 * phase));
    }
    return moved;
}

bool in_circle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
    const Vector2d d = a - p, e = b - p, f = c - p;
    return d.squaredNorm() * (e.x() * f.y() - f.x() * e.y()) -
               e.squaredNorm() * (d.x() * f.y() - f.x() * d.y()) +
               f.squaredNorm() * (d.x() * e.y() - e.x() * d.y()) >
           0;
}

// Three corners far outside, appended to the points.
Flat with_frame(const Flat& points) {
    const Eigen::RowVector2d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    const Eigen::RowVector2d centre = (low + high) / 2;
    const double size = 1000 * (high - low).maxCoeff();
    Flat all(points.rows() + 3, 2);
    all << points, centre + Eigen::RowVector2d(-size, -size), centre + Eigen::RowVector2d(size, -size),
        centre + Eigen::RowVector2d(0, size);
    return all;
}

// The boundary of the removed triangles: their edges that occur in one direction only.
std::vector<Edge> rim(const std::vector<Triangle>& removed) {
    std::vector<Edge> edges;
    for (const Triangle& t : removed) {
        for (int k = 0; k < 3; ++k) {
            const Edge edge{t[k], t[(k + 1) % 3]};
            const auto twin = std::ranges::find(edges, Edge{edge[1], edge[0]});
            if (twin != edges.end()) {
                edges.erase(twin);
            } else {
                edges.push_back(edge);
            }
        }
    }
    return edges;
}

}  // namespace

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

std::vector<Triangle> delaunay(const Flat& points) {
    const int n = static_cast<int>(points.rows());
    if (n < 3) throw std::invalid_argument("delaunay: fewer than three points");
    const Flat all = with_frame(shifted(points));
    const auto at = [&](int i) -> Vector2d { return all.row(i); };
    std::vector<Triangle> triangles = {{n, n + 1, n + 2}};
    for (int i = 0; i < n; ++i) {
        const auto keeps = [&](const Triangle& t) { return !in_circle(at(t[0]), at(t[1]), at(t[2]), at(i)); };
        const auto middle = std::stable_partition(triangles.begin(), triangles.end(), keeps);
        const std::vector<Triangle> removed(middle, triangles.end());
        if (removed.empty()) throw std::invalid_argument("delaunay: two points in one place");
        triangles.erase(middle, triangles.end());
        for (const auto& [from, to] : rim(removed)) triangles.push_back({from, to, i});
    }
    std::erase_if(triangles, [&](const Triangle& t) { return std::ranges::max(t) >= n; });
    return triangles;
}

}  // namespace viaface
