// A face in the order in which it is drawn, one layer per material.
#pragma once

#include <span>
#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

struct Layer {
    Material material;
    std::vector<Triangle> triangles;
};

// Lashes come last, as they are laid over all else; within the rest what is in front comes first.
std::vector<Layer> layers_of(const Face& face);

std::vector<Triangle> triangles_of(const Face& face, Material material);

// Their corners, each once, in rising order.
std::vector<int> nodes_of(std::span<const Triangle> triangles);

// Seen through the opening of the mouth alone.
bool inside_mouth(Material material);

bool two_sided(Material material);

inline constexpr float kLashesBefore = 3;  // mm: lashes are drawn over the lids they grow from

}  // namespace viaface
