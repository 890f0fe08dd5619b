// Faces of few triangles for tests of the picture: squares and balls, each a part of one colour.
#pragma once

#include <cstdint>
#include <vector>

#include "facemodel/face.hpp"
#include "synth/film/frame.hpp"

namespace viaface::testing {

inline constexpr double kMiddleY = 41, kMiddleZ = -106;  // mm: what a square picture has in its middle

void add_part(Face& face, Material material, const Nodes& nodes, const std::vector<Triangle>& triangles);

// A square facing the camera, `side` mm, in the middle of the picture and `nearer` mm nearer than the middle.
void add_square(Face& face, Material material, double side, double nearer = 0);

// A ball of rings x segments quads.
void add_ball(Face& face, Material material, double radius, const Eigen::Vector3d& middle, int rings = 12);

// A large ball of skin with three small ones before it: tongue, eye and lash.
Face two_balls();

// Waves of another length in each channel, from `low` to `high`.
Texture waves(int side, int channels, double low, double high);

// The balls with colours, roughness and bumps all over, repeated sideways.
Face painted_balls();

// The small balls wander, now and then one stands still.
Nodes wandering(const Face& face, int step);

std::vector<std::uint8_t> bytes(const FrameView& view);  // top row first

}  // namespace viaface::testing
