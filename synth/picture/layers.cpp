#include "synth/picture/layers.hpp"

#include <algorithm>

namespace viaface {
namespace {

constexpr Material kDrawOrder[] = {Material::kSkin,   Material::kLips,  Material::kCloth,
                                   Material::kEye,    Material::kTeeth, Material::kGums,
                                   Material::kTongue, Material::kMouth, Material::kLash};

}  // namespace

std::vector<Layer> layers_of(const Face& face) {
    std::vector<Layer> layers;
    for (const Material material : kDrawOrder) layers.push_back({material, triangles_of(face, material)});
    return layers;
}

std::vector<Triangle> triangles_of(const Face& face, Material material) {
    std::vector<Triangle> triangles;
    for (const FacePart& part : face.parts) {
        if (part.material != material) continue;
        triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    }
    return triangles;
}

std::vector<int> nodes_of(std::span<const Triangle> triangles) {
    std::vector<int> nodes;
    for (const Triangle& triangle : triangles) nodes.insert(nodes.end(), triangle.begin(), triangle.end());
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

bool inside_mouth(Material m) { return m >= Material::kMouth && m <= Material::kTongue; }

bool two_sided(Material material) {
    return material == Material::kMouth || material == Material::kLash || material == Material::kCloth;
}

}  // namespace viaface
