#include "facemodel/remesh.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace viaface {
namespace {

constexpr int kGridCells = 96;  // per side

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector3d barycentric(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
    const double area = cross(b - a, c - a);
    const double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
    return {1 - wb - wc, wb, wc};
}

double half_tangent(const Vector3d& at, const Vector3d& a, const Vector3d& b) {
    const Vector3d u = (a - at).normalized(), v = (b - at).normalized();
    return std::tan(0.5 * std::acos(std::clamp(u.dot(v), -1.0, 1.0)));
}

int cell_of(double coordinate) {
    return std::clamp(static_cast<int>((coordinate + 1) / 2 * kGridCells), 0, kGridCells - 1);
}

double loop_length(const Loop& loop, const Nodes& scan) {
    double sum = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        sum += (scan.row(loop[(k + 1) % loop.size()]) - scan.row(loop[k])).norm();
    }
    return sum;
}

// The outer loop on the unit circle by arc length, its highest node on top.
void place_on_circle(const Loop& loop, const Nodes& scan, std::vector<Vector2d>& uv) {
    const double whole = loop_length(loop, scan);
    std::vector<double> arc(loop.size(), 0);
    for (std::size_t k = 1; k < loop.size(); ++k) {
        arc[k] = arc[k - 1] + (scan.row(loop[k]) - scan.row(loop[k - 1])).norm();
    }
    const auto top =
        std::max_element(loop.begin(), loop.end(), [&](int a, int b) { return scan(a, 1) < scan(b, 1); });
    const double start = arc[static_cast<std::size_t>(top - loop.begin())];
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const double angle = std::numbers::pi * (0.5 + 2 * (arc[k] - start) / whole);
        uv[static_cast<std::size_t>(loop[k])] = {std::cos(angle), std::sin(angle)};
    }
}

// A piece of a scan whose holes are closed by a hub each.
struct Closed {
    std::vector<Vector3d> places;
    std::vector<Triangle> triangles;
};

Closed closed_over(const std::vector<Loop>& holes, const Nodes& scan, std::vector<Triangle> triangles) {
    Closed closed{{}, std::move(triangles)};
    for (Eigen::Index i = 0; i < scan.rows(); ++i) closed.places.push_back(scan.row(i).transpose());
    for (const Loop& hole : holes) {
        Vector3d hub = Vector3d::Zero();
        for (const int node : hole)
            hub += closed.places[static_cast<std::size_t>(node)] / static_cast<double>(hole.size());
        const int index = static_cast<int>(closed.places.size());
        for (std::size_t k = 0; k < hole.size(); ++k) {
            closed.triangles.push_back({hole[(k + 1) % hole.size()], hole[k], index});
        }
        closed.places.push_back(hub);
    }
    return closed;
}

// Nodes that are not fixed are the mean-value weighted means of their neighbours. [Floater03]
class MeanValues {
  public:
    MeanValues(const Closed& surface, const Loop& fixed, const std::vector<Vector2d>& uv)
        : uv_(uv), fixed_(surface.places.size(), 0) {
        for (const int node : fixed) fixed_[static_cast<std::size_t>(node)] = 1;
        number_rows(surface.triangles);
        right_ = Eigen::MatrixX2d::Zero(static_cast<Eigen::Index>(rows_.size()), 2);
        for (const Triangle& t : surface.triangles) {
            for (std::size_t k = 0; k < 3; ++k) couple(surface, t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
        }
    }

    void solve_into(std::vector<Vector2d>& uv) const {
        Eigen::SparseMatrix<double> system(right_.rows(), right_.rows());
        system.setFromTriplets(entries_.begin(), entries_.end());
        Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(system);
        if (solver.info() != Eigen::Success) throw std::runtime_error("the chart's system has no solution");
        const Eigen::MatrixX2d solved = solver.solve(right_);
        for (const auto& [node, row] : rows_)
            uv[static_cast<std::size_t>(node)] = solved.row(row).transpose();
    }

  private:
    bool is_fixed(int node) const { return fixed_[static_cast<std::size_t>(node)] != 0; }

    void number_rows(const std::vector<Triangle>& triangles) {
        for (const Triangle& t : triangles) {
            for (const int node : t) {
                if (!is_fixed(node)) rows_.emplace(node, 0);
            }
        }
        int count = 0;
        for (auto& [node, row] : rows_) row = count++;
    }

    void couple(const Closed& surface, int node, int one, int other) {
        if (is_fixed(node)) return;
        const auto place = [&](int i) -> const Vector3d& {
            return surface.places[static_cast<std::size_t>(i)];
        };
        const double tangent = half_tangent(place(node), place(one), place(other));
        add(rows_.at(node), one, tangent / (place(one) - place(node)).norm());
        add(rows_.at(node), other, tangent / (place(other) - place(node)).norm());
    }

    void add(int row, int neighbour, double weight) {
        entries_.emplace_back(row, row, weight);
        if (is_fixed(neighbour)) {
            right_.row(row) += weight * uv_[static_cast<std::size_t>(neighbour)].transpose();
        } else {
            entries_.emplace_back(row, rows_.at(neighbour), -weight);
        }
    }

    const std::vector<Vector2d>& uv_;
    std::vector<char> fixed_;  // by node
    std::map<int, int> rows_;  // by node that is not fixed
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::MatrixX2d right_;
};

}  // namespace

Vector3d Anchor::at(const Nodes& scan) const {
    return weights[0] * scan.row(nodes[0]).transpose() + weights[1] * scan.row(nodes[1]).transpose() +
           weights[2] * scan.row(nodes[2]).transpose();
}

Nodes nodes_at(const std::vector<Anchor>& anchors, const Nodes& scan) {
    Nodes nodes(static_cast<Eigen::Index>(anchors.size()), 3);
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        nodes.row(static_cast<Eigen::Index>(i)) = anchors[i].at(scan).transpose();
    }
    return nodes;
}

std::vector<Loop> boundary_loops(const std::vector<Triangle>& triangles) {
    std::map<std::pair<int, int>, bool> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges[{t[k], t[(k + 1) % 3]}] = true;
    }
    std::map<int, int> next;
    for (const auto& [edge, there] : edges) {
        if (!edges.contains({edge.second, edge.first})) next[edge.first] = edge.second;
    }
    std::vector<Loop> loops;
    while (!next.empty()) {
        Loop loop;
        for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
            loop.push_back(at->second);
            next.erase(at);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

Chart::Chart(const Nodes& scan, std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
    holes_ = boundary_loops(triangles_);
    if (holes_.empty()) throw std::invalid_argument("a chart needs a piece with a boundary");
    const auto longest = std::max_element(holes_.begin(), holes_.end(),
                                          [](const Loop& a, const Loop& b) { return a.size() < b.size(); });
    outer_ = *longest;
    holes_.erase(longest);
    flatten(scan);
    build_grid();
}

void Chart::flatten(const Nodes& scan) {
    const Closed closed = closed_over(holes_, scan, triangles_);
    uv_.assign(closed.places.size(), Vector2d::Zero());
    place_on_circle(outer_, scan, uv_);
    MeanValues(closed, outer_, uv_).solve_into(uv_);
}

void Chart::build_grid() {
    grid_.assign(kGridCells * kGridCells, {});
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        Vector2d low = uv(triangles_[i][0]), high = low;
        for (const int node : triangles_[i]) {
            low = low.cwiseMin(uv(node));
            high = high.cwiseMax(uv(node));
        }
        for (int y = cell_of(low.y()); y <= cell_of(high.y()); ++y) {
            for (int x = cell_of(low.x()); x <= cell_of(high.x()); ++x) {
                grid_[static_cast<std::size_t>(y * kGridCells + x)].push_back(static_cast<int>(i));
            }
        }
    }
}

Vector2d Chart::uv(const Anchor& anchor) const {
    return anchor.weights[0] * uv(anchor.nodes[0]) + anchor.weights[1] * uv(anchor.nodes[1]) +
           anchor.weights[2] * uv(anchor.nodes[2]);
}

Anchor Chart::locate(const Vector2d& place) const {
    const int cx = cell_of(place.x()), cy = cell_of(place.y());
    Anchor best;
    double lowest = -1e300;
    for (int reach = 0; reach < kGridCells && lowest < -0.5; ++reach) {
        for (int y = std::max(cy - reach, 0); y <= std::min(cy + reach, kGridCells - 1); ++y) {
            for (int x = std::max(cx - reach, 0); x <= std::min(cx + reach, kGridCells - 1); ++x) {
                for (const int i : grid_[static_cast<std::size_t>(y * kGridCells + x)]) {
                    const Triangle& t = triangles_[static_cast<std::size_t>(i)];
                    const Vector3d weights = barycentric(uv(t[0]), uv(t[1]), uv(t[2]), place);
                    if (weights.minCoeff() <= lowest) continue;
                    lowest = weights.minCoeff();
                    best = {t, weights};
                }
            }
        }
    }
    best.weights = best.weights.cwiseMax(0);
    best.weights /= best.weights.sum();
    return best;
}

bool inside(const std::vector<Vector2d>& polygon, const Vector2d& place) {
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vector2d &a = polygon[i], &b = polygon[j];
        if ((a.y() > place.y()) != (b.y() > place.y()) &&
            place.x() < (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y()) + a.x()) {
            in = !in;
        }
    }
    return in;
}

}  // namespace viaface
