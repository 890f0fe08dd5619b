// A material's texture as places on the resting face.
#pragma once

#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

struct Texel {
    Eigen::Vector3f place;             // mm, head frame
    Eigen::Vector3f normal;            // unit
    Eigen::Vector3f along_u, along_v;  // unit, of the node tangents: the frame of the normal texture
    float u = 0, v = 0;
    int part = -1;  // index into Face::parts; -1 where no triangle falls
};

struct TexelGrid {
    int side = 0;
    std::vector<Texel> texels;  // [side x side], top row first
};

// Where parts of one material overlap in the texture, the part named first stays.
TexelGrid lay_out(const Face& face, Material material, int side);

// Spreads painted texels over `reach` texels round about, so that no gap shows at seams and smaller mip
// levels.
void spread(Texture& texture, const TexelGrid& grid, int reach);

}  // namespace viaface
