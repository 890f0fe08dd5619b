// Where points sit on the face, so that they can be read off any pose of it.
#pragma once

#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

// A mean of nodes and a step off the surface.
struct Seat {
    Triangle nodes{};
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();  // sum 1
    Eigen::Vector3d step = Eigen::Vector3d::Zero();     // mm

    Eigen::Vector3d at(const Nodes& mesh) const;
};

// On the nearest of the triangles.
Seat seat_on(const Nodes& mesh, const std::vector<Triangle>& triangles, const Eigen::Vector3d& place);

// A row of the lips as a ring of degenerate triangles, so that a point may sit between two columns.
std::vector<Triangle> ring_of(const LipGrid& lips, int row);

// Column of a seat on a ring, with its part of the way to the next.
double column_of(const Seat& seat, const LipGrid& lips, int row);

}  // namespace viaface
