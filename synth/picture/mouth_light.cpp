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

float in_steps(float light) { return std::round(std::clamp(light, 0.0f, 1.0f) * 255) / 255; }

// The column of the other lip that meets this one.
int opposite(int column) { return (LipGrid::kColumns * 3 / 2 - column) % LipGrid::kColumns; }

Opening opening_of(const LipGrid& lips, const NodesF& places) {
    Opening corners;
    for (int i = 0; i < kCorners; ++i) {
        corners[i] = places.row(lips.node(LipGrid::kRows - 1, i * kStep)).transpose();
    }
    return corners;
}

// angle / (2 pi sin(angle)) from the angle's cosine: a rational fit, within 1e-3 (S. Hill and E. Heitz,
// "Real-time area lighting: a journey from research to production", SIGGRAPH 2016).
float edge_share(float cosine) {
    const float c = std::abs(cosine);
    const float share =
        (0.8543985f + (0.4965155f + 0.0145206f * c) * c) / (3.4175940f + (4.1616724f + c) * c);
    return cosine > 0 ? share : 0.5f / std::sqrt(std::max(1 - c * c, 1e-7f)) - share;
}

// Lambert's sum; outwards, behind the opening and in front of it.
Vector3f flow(const Opening& corners, const Vector3f& point) {
    Vector3f sum = Vector3f::Zero();
    Vector3f from = (corners.back() - point).normalized();
    for (const Vector3f& corner : corners) {
        const Vector3f to = (corner - point).normalized();
        sum += to.cross(from) * edge_share(from.dot(to));  // the contour runs clockwise seen from inside
        from = to;
    }
    return sum;
}

float light_at(const Opening& corners, const Vector3f& point, const Vector3f& normal) {
    const Vector3f f = flow(corners, point);
    if (f.dot(corners.front() + corners[kCorners / 2] - 2 * point) < 0) return 1;  // in front of the lips
    const float facing = std::max(0.0f, normal.dot(f));
    return std::sqrt(kFromAround * f.norm() + (1 - kFromAround) * facing);
}

}  // namespace

MouthLight::MouthLight(const Face& face) : lips_(face.lips) {
    for (const FacePart& part : face.parts) {
        has_lips_ |= part.material == Material::kLips;
        if (part.material < Material::kMouth || part.material > Material::kTongue) continue;
        for (int i = 0; i < part.nodes; ++i) inside_.push_back(part.first_node + i);
    }
}

void MouthLight::compute(const NodesF& places, const NodesF& normals, std::vector<float>& light) const {
    light.assign(places.rows(), 1.0f);
    if (!has_lips_) return;
    const Opening corners = opening_of(lips_, places);
    for (const int node : inside_) {
        light[node] = in_steps(light_at(corners, places.row(node), normals.row(node)));
    }
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
