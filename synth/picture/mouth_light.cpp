#include "synth/picture/mouth_light.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Vector3f;

constexpr int kStep = 2;  // columns from corner to corner of the polygon
constexpr int kCorners = LipGrid::kColumns / kStep;
using Opening = std::array<Vector3f, kCorners>;

constexpr float kTouch = 3.0f;       // mm: the gap at which lips stop darkening each other, 1/e
constexpr int kFirstDarkRow = 9;     // rows of the lips from here inwards darken
constexpr float kDarkest = 0.75f;    // light lost at the inner contour of closed lips
constexpr float kFromAround = 0.5f;  // share of the light that comes from everywhere

float in_steps(float light) { return float(int(std::clamp(light, 0.0f, 1.0f) * 255 + 0.5f)) / 255; }

// The column of the other lip that meets this one.
int opposite(int column) { return (LipGrid::kColumns * 3 / 2 - column) % LipGrid::kColumns; }

Opening opening_of(const LipGrid& lips, const NodesF& places) {
    Opening corners;
    for (int i = 0; i < kCorners; ++i) {
        corners[i] = places.row(lips.node(LipGrid::kRows - 1, i * kStep)).transpose();
    }
    return corners;
}

constexpr int kAtOnce = 4;    // points
constexpr int kInOneGo = 64;  // points, a multiple of kAtOnce
using Numbers = Eigen::Array<float, kAtOnce, 1>;
struct Vectors {
    Numbers x, y, z;
};

Numbers dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vectors unit_way(const Vectors& from, const Vector3f& to) {
    const Vectors way{to.x() - from.x, to.y() - from.y, to.z() - from.z};
    const Numbers shorter = 1 / dot(way, way).max(1e-12f).sqrt();
    return {way.x * shorter, way.y * shorter, way.z * shorter};
}

// angle / (2 pi sin(angle)) from the angle's cosine: a rational fit, within 1e-3 (S. Hill and E. Heitz,
// "Real-time area lighting: a journey from research to production", SIGGRAPH 2016).
Numbers edge_share(const Numbers& cosine) {
    const Numbers c = cosine.abs();
    const Numbers share =
        (0.8543985f + (0.4965155f + 0.0145206f * c) * c) / (3.4175940f + (4.1616724f + c) * c);
    return (cosine > 0).select(share, 0.5f / (1 - c * c).max(1e-7f).sqrt() - share);
}

// Lambert's sum; outwards, behind the opening and in front of it.
Vectors flow(const Opening& corners, const Vectors& points) {
    Vectors sum{Numbers::Zero(), Numbers::Zero(), Numbers::Zero()};
    Vectors from = unit_way(points, corners.back());
    for (const Vector3f& corner : corners) {
        const Vectors to = unit_way(points, corner);
        const Numbers share = edge_share(dot(from, to));
        sum.x += (to.y * from.z - to.z * from.y) * share;  // the contour runs clockwise seen from inside
        sum.y += (to.z * from.x - to.x * from.z) * share;
        sum.z += (to.x * from.y - to.y * from.x) * share;
        from = to;
    }
    return sum;
}

Numbers light_at(const Opening& corners, const Vectors& points, const Vectors& normals) {
    const Vectors f = flow(corners, points);
    const Vector3f both = corners.front() + corners[kCorners / 2];
    const Vectors ahead{both.x() - 2 * points.x, both.y() - 2 * points.y, both.z() - 2 * points.z};
    const Numbers facing = dot(normals, f).max(0.0f);
    const Numbers light = (kFromAround * dot(f, f).sqrt() + (1 - kFromAround) * facing).sqrt();
    return (dot(f, ahead) < 0).select(1.0f, light);  // in front of the lips
}

Vectors rows(const NodesF& all, const int* nodes, int count) {
    Vectors some;
    for (int i = 0; i < kAtOnce; ++i) {
        const auto row = all.row(nodes[std::min(i, count - 1)]);
        some.x[i] = row.x(), some.y[i] = row.y(), some.z[i] = row.z();
    }
    return some;
}

}  // namespace

MouthLight::MouthLight(const Face& face) : lips_(face.lips) {
    for (const FacePart& part : face.parts) has_lips_ |= part.material == Material::kLips;
}

void MouthLight::compute(const NodesF& places, const NodesF& normals, std::span<const int> inside,
                         WorkPool& pool, std::vector<float>& light) const {
    if (!has_lips_) return;
    const Opening corners = opening_of(lips_, places);
    const int nodes = static_cast<int>(inside.size());
    pool.share((nodes + kInOneGo - 1) / kInOneGo, [&](int item, int) {
        const int end = std::min(nodes, (item + 1) * kInOneGo);
        for (int first = item * kInOneGo; first < end; first += kAtOnce) {
            const int* some = &inside[first];
            const int count = std::min(kAtOnce, end - first);
            const Numbers lights = light_at(corners, rows(places, some, count), rows(normals, some, count));
            for (int i = 0; i < count; ++i) light[some[i]] = in_steps(lights[i]);
        }
    });
    light_lips(places, light);
}

void MouthLight::light_lips(const NodesF& places, std::vector<float>& light) const {
    for (int column = 0; column < LipGrid::kColumns; ++column) {
        const int inner = lips_.node(LipGrid::kRows - 1, column);
        const int across = lips_.node(LipGrid::kRows - 1, opposite(column));
        const float gap = (places.row(inner) - places.row(across)).norm();
        for (int row = kFirstDarkRow; row < LipGrid::kRows; ++row) {
            const float depth = float(row - kFirstDarkRow) / (LipGrid::kRows - 1 - kFirstDarkRow);
            light[lips_.node(row, column)] = in_steps(1 - kDarkest * depth * depth * std::exp(-gap / kTouch));
        }
    }
}

}  // namespace viaface
