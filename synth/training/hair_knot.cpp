#include "synth/training/hair_knot.hpp"

#include <cmath>
#include <numbers>

#include "synth/training/bake_noise.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

constexpr int kRings = 11, kAround = 20, kNodes = kRings * kAround + 2;
constexpr float kMargin = 0.005f, kAcross = 0.065f, kUp = 0.10f;  // of the texture

// Both sides share the picture: u goes there and back.
Eigen::RowVector2f uv(float round, float up) {
    const float there = round < 0.5f ? 2 * round : 2 - 2 * round;
    return {kMargin + kAcross * there, kMargin + kUp * up};
}

}  // namespace

PartMesh hair_knot(const HairKnot& knot) {
    PartMesh part{"hair_knot", Material::kSkin, Drive::kFixed, Nodes(kNodes, 3), Uvs(kNodes, 2), {}};
    const auto put = [&](int node, const Vector3f& way) {
        const float uneven = 0.95f + 0.14f * (noise(way * 2.1f) - 0.5f);
        part.nodes.row(node) =
            (knot.middle + uneven * knot.radii.cwiseProduct(way)).cast<double>().transpose();
    };
    for (int r = 0; r < kRings; ++r) {
        const float up = static_cast<float>(r + 1) / (kRings + 1),
                    height = -std::cos(std::numbers::pi_v<float> * up);
        const float wide = std::sqrt(1 - height * height);
        for (int k = 0; k < kAround; ++k) {
            const float round = static_cast<float>(k) / kAround,
                        angle = 2 * std::numbers::pi_v<float> * round;
            put(r * kAround + k, {wide * std::sin(angle), height, -wide * std::cos(angle)});
            part.uvs.row(r * kAround + k) = uv(round, up);
        }
    }
    put(kNodes - 2, -Vector3f::UnitY());
    put(kNodes - 1, Vector3f::UnitY());
    part.uvs.row(kNodes - 2) = uv(0.25f, 0);
    part.uvs.row(kNodes - 1) = uv(0.25f, 1);
    const auto node = [](int r, int k) { return r * kAround + k % kAround; };
    for (int k = 0; k < kAround; ++k) {
        part.triangles.push_back({kNodes - 2, node(0, k), node(0, k + 1)});
        for (int r = 0; r + 1 < kRings; ++r) {
            part.triangles.push_back({node(r, k), node(r + 1, k), node(r + 1, k + 1)});
            part.triangles.push_back({node(r, k), node(r + 1, k + 1), node(r, k + 1)});
        }
        part.triangles.push_back({kNodes - 1, node(kRings - 1, k + 1), node(kRings - 1, k)});
    }
    return part;
}

}  // namespace viaface
