// Faces of few triangles for tests of the picture: squares and balls, each a part of one colour.
#pragma once

#include "facemodel/face.hpp"

namespace viaface::testing {

inline constexpr double kMiddleY = 41, kMiddleZ = -106;  // mm: what a square picture has in its middle

void add_part(Face& face, Material material, const Nodes& nodes, const std::vector<Triangle>& triangles);

// A square facing the camera, `side` mm, in the middle of the picture and `nearer` mm nearer than the middle.
void add_square(Face& face, Material material, double side, double nearer = 0);

// A ball of rings x segments quads.
void add_ball(Face& face, Material material, double radius, const Eigen::Vector3d& middle, int rings = 12);

}  // namespace viaface::testing
