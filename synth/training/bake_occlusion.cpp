#include "synth/training/bake_occlusion.hpp"

#include "synth/picture/depth_map.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

constexpr int kDirections = 128, kMapSide = 512;
constexpr float kBias = 0.9f, kSlantedBias = 2.2f;  // mm in front of itself that a surface does not shade

}  // namespace

std::vector<float> openness(const Face& face, const std::vector<Triangle>& casters, const TexelGrid& grid) {
    const NodesF places = face.rest.cast<float>();
    std::vector<float> open(grid.texels.size(), 0), weight(grid.texels.size(), 0);
    for (int k = 0; k < kDirections; ++k) {
        const Vector3f towards = spiral_way(k, kDirections);
        const DepthMap map(places, casters, towards, kMapSide);
        for (std::size_t i = 0; i < grid.texels.size(); ++i) {
            const Texel& texel = grid.texels[i];
            if (texel.part < 0) continue;
            const float facing = texel.normal.dot(towards);
            if (facing <= 0) continue;
            const float w = facing * (0.6f + 0.4f * towards.y());
            weight[i] += w;
            if (map.lit(texel.place, kBias + kSlantedBias * (1 - facing))) open[i] += w;
        }
    }
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = weight[i] > 0 ? open[i] / weight[i] : 1;
    return open;
}

}  // namespace viaface
