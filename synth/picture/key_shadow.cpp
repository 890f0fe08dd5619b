#include "synth/picture/key_shadow.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "synth/picture/depth_map.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/lights.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

constexpr int kRings = 2, kFirstRing = 4, kMapSide = 320;
constexpr int kPasses = 2;
constexpr float kDarkest = 0.85f;                // what is left comes back from walls
constexpr float kDisc = 0.17f;                   // the light's radius over its distance
constexpr float kOff = 2.5f, kBias = 2.0f;       // mm: along the normal and towards the light
constexpr float kTurned = -0.25f, kFace = 0.1f;  // cosines between which shadow gives way to shading

bool casts(Material material) {
    return material == Material::kSkin || material == Material::kCloth || material == Material::kLips;
}

std::vector<Triangle> casters(const Face& face) {
    std::vector<Triangle> triangles;
    for (const FacePart& part : face.parts) {
        if (casts(part.material))
            triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    }
    return triangles;
}

std::vector<bool> shaded(const Face& face) {
    std::vector<bool> nodes(face.rest.rows(), false);
    for (const FacePart& part : face.parts) {
        if (!casts(part.material)) continue;
        for (const Triangle& t : part.triangles) {
            for (const int node : t) nodes[node] = true;
        }
    }
    return nodes;
}

// Ways to places of the light's disc, head frame.
std::vector<Vector3f> ways_to_key(const View& view) {
    const Eigen::Matrix3f turn = camera_of(view).world_from_head.topLeftCorner<3, 3>().cast<float>();
    const Vector3f middle = turn.transpose() * Vector3f(lights::kKeyWay).normalized();
    const Vector3f right = middle.unitOrthogonal(), up = middle.cross(right);
    std::vector<Vector3f> ways;
    for (int ring = 0; ring < kRings; ++ring) {
        const int count = kFirstRing * (ring + 1);
        const float out = kDisc * (ring + 0.7f) / kRings;
        for (int i = 0; i < count; ++i) {
            const float angle = 6.2831853f * (i + 0.5f * ring) / count;
            ways.push_back((middle + out * (std::cos(angle) * right + std::sin(angle) * up)).normalized());
        }
    }
    return ways;
}

// Means over neighbours: the light's disc is seen at a few places alone.
void soften(std::vector<float>& shares, const std::vector<Triangle>& triangles) {
    std::vector<float> sums(shares.size(), 0), counts(shares.size(), 0);
    for (const Triangle& t : triangles) {
        for (const int node : t) {
            sums[node] += shares[t[0]] + shares[t[1]] + shares[t[2]];
            counts[node] += 3;
        }
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (counts[i] > 0) shares[i] = sums[i] / counts[i];
    }
}

// Lips move too much for a shadow of their own: each column has that of its outer end.
void spread_over_lips(const LipGrid& lips, std::vector<float>& shares) {
    for (int row = 1; row < LipGrid::kRows; ++row) {
        for (int column = 0; column < LipGrid::kColumns; ++column)
            shares[lips.node(row, column)] = shares[lips.node(0, column)];
    }
}

float smooth(float t) {
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

}  // namespace

std::vector<float> key_shares(const Face& face, const View& view) {
    const NodesF places = face.rest.cast<float>();
    NodesF normals;
    NodeNormals(face).compute(places, normals);
    const std::vector<Triangle> triangles = casters(face);
    const std::vector<bool> takes = shaded(face);
    const std::vector<Vector3f> ways = ways_to_key(view);
    std::vector<float> shares(places.rows(), 1);
    for (const Vector3f& way : ways) {
        const DepthMap map(places, triangles, way, kMapSide);
        for (Eigen::Index i = 0; i < places.rows(); ++i) {
            if (!takes[i]) continue;
            const Vector3f normal = normals.row(i), off = places.row(i).transpose() + kOff * normal;
            const float faces = smooth((normal.dot(way) - kTurned) / (kFace - kTurned));
            if (!map.lit(off, kBias)) shares[i] -= faces / static_cast<float>(ways.size());
        }
    }
    for (int pass = 0; pass < kPasses; ++pass) soften(shares, triangles);
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = 1 - kDarkest * (1 - shares[face.weld[i]]);
    if (!triangles_of(face, Material::kLips).empty()) spread_over_lips(face.lips, shares);
    return shares;
}

}  // namespace viaface
