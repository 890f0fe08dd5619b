// Triangles over places in a plane: a sweep that joins each place to the hull of those on its left, edges
// flipped until the triangulation is Delaunay's [Lawson77], and edges that are asked for put in by flips.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "facemodel/cylinder.hpp"

namespace viaface {

// Twice the area of a, b, c: positive when counter-clockwise.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

// Whether the angles opposite edge (a, b), seen from c and d, make more than a straight angle: then (c, d) is
// the better edge. In the plane: d lies in the circle through a, b and c.
template <class Place>
bool obtuse_opposite(const Place& a, const Place& b, const Place& c, const Place& d) {
    constexpr double kStraight = 3.14159265358979 + 1e-6;
    const auto angle_at = [&](const Place& apex) {
        const Place u = (a - apex).normalized(), v = (b - apex).normalized();
        return std::acos(std::clamp(u.dot(v), -1.0, 1.0));
    };
    return angle_at(c) + angle_at(d) > kStraight;
}

// Triangles, counter-clockwise, with the two at each edge at hand.
class Triangulation {
  public:
    using Edge = std::pair<int, int>;                        // the lesser first
    using Better = std::function<bool(int, int, int, int)>;  // edge (c, d) than (a, b)

    // Delaunay's triangles over the convex hull. std::invalid_argument for fewer than three places or two in
    // one place.
    explicit Triangulation(const std::vector<Eigen::Vector2d>& places);

    const std::vector<Triangle>& triangles() const { return triangles_; }

    // Puts an edge in. std::runtime_error when no flips do.
    void insert(int a, int b);
    void restrict_to(std::vector<Triangle> kept);
    // Flips inner edges that are not kept while it is better. std::runtime_error when that has no end in 60
    // times over all edges.
    void flip_while(const std::set<Edge>& kept, const Better& better);

    static Edge edge_of(int a, int b) { return std::minmax(a, b); }

  private:
    const Eigen::Vector2d& at(int i) const { return places_[static_cast<std::size_t>(i)]; }
    int apex(int triangle, const Edge& edge) const;
    std::pair<int, int> opposite(const Edge& edge) const;
    bool convex(const Edge& edge, int c, int d) const;
    bool crosses(const Edge& edge, int a, int b) const;

    void note(int index);
    void forget(int index);
    void set(int index, int a, int b, int c);
    void add(int a, int b, int c);
    void flip(Edge edge);
    std::vector<int> swept_order() const;
    void sweep();

    std::vector<Eigen::Vector2d> places_;  // turned a little
    std::vector<Triangle> triangles_;
    std::map<Edge, std::array<int, 2>> sides_;  // triangles; -1 where there is none
};

// Delaunay's triangles over all points, counter-clockwise, of their convex hull. Points on one circle or line
// are told apart as if each had been moved by a millionth of a unit. Throws as Triangulation.
std::vector<Triangle> delaunay(const Flat& points);

}  // namespace viaface
