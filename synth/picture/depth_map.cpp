#include "synth/picture/depth_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr float kExtent = 230;  // mm from the middle of the head to the edge of a map
const Vector3f kMiddle(0, 20, -90);

Matrix3f map_axes(const Vector3f& towards) {
    Matrix3f axes;
    axes.row(0) = towards.unitOrthogonal().transpose();
    axes.row(1) = towards.cross(axes.row(0).transpose()).transpose();
    axes.row(2) = towards.transpose();
    return axes;
}

}  // namespace

Vector3f spiral_way(int index, int count) {
    const float y = 1 - 2 * (index + 0.5f) / count;
    const float across = std::sqrt(1 - y * y),
                angle = index * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
    return {across * std::cos(angle), y, across * std::sin(angle)};
}

DepthMap::DepthMap(const NodesF& places, const std::vector<Triangle>& casters, const Vector3f& towards,
                   int side)
    : side_(side), axes_(map_axes(towards)), depth_(std::size_t(side) * side, -1e9f) {
    for (const auto& [a, b, c] : casters) {
        cast(project(places.row(a)), project(places.row(b)), project(places.row(c)));
    }
}

bool DepthMap::lit(const Vector3f& place, float bias) const {
    const Vector3f p = project(place);
    const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
    if (p.x() < 0 || p.y() < 0 || x >= side_ || y >= side_) return true;
    return p.z() + bias >= depth_[std::size_t(y) * side_ + x];
}

Vector3f DepthMap::project(const Vector3f& place) const {
    const Vector3f p = axes_ * (place - kMiddle);
    const float scale = side_ / (2 * kExtent);
    return {p.x() * scale + side_ / 2, p.y() * scale + side_ / 2, p.z()};
}

void DepthMap::cast(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    const float area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
    if (std::abs(area) < 1e-9f) return;
    const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
    const auto [low, high] = std::minmax({a.y(), b.y(), c.y()});
    const int x0 = std::max(0, int(std::ceil(left - 0.5f))), x1 = std::min(side_ - 1, int(right - 0.5f));
    const int y0 = std::max(0, int(std::ceil(low - 0.5f))), y1 = std::min(side_ - 1, int(high - 0.5f));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const float px = x + 0.5f - a.x(), py = y + 0.5f - a.y();
            const float s = (px * (c.y() - a.y()) - py * (c.x() - a.x())) / area;
            const float t = ((b.x() - a.x()) * py - (b.y() - a.y()) * px) / area;
            if (s < 0 || t < 0 || s + t > 1) continue;
            float& depth = depth_[std::size_t(y) * side_ + x];
            depth = std::max(depth, a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
        }
    }
}

}  // namespace viaface
