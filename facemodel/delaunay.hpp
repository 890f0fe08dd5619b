// Delaunay triangulation of points in a plane. [Bowyer 1981; Watson 1981]
#pragma once

#include "facemodel/cylinder.hpp"

namespace viaface {

// Twice the area of a, b, c: positive when counter-clockwise.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

// Triangles over all points, counter-clockwise, of their convex hull. Points on one circle are told apart as
// if each had been moved by a millionth of a unit. std::invalid_argument for fewer than three points or two
// in one place.
std::vector<Triangle> delaunay(const Flat& points);

}  // namespace viaface
