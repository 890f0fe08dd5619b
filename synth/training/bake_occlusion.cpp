#include "synth/training/bake_occlusion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr int kDirections = 128, kMapSide = 512;
constexpr float kExtent = 230;                      // mm from the middle of the head to the edge of a map
constexpr float kBias = 0.9f, kSlantedBias = 2.2f;  // mm in front of itself that a surface does not shade
const Vector3f kMiddle(0, 20, -90);

// Directions spread evenly over the sphere on a spiral.
Vector3f direction(int index) {
    const float y = 1 - 2 * (index + 0.5f) / kDirections;
    const float across = std::sqrt(1 - y * y),
                angle = index * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
    return {across * std::cos(angle), y, across * std::sin(angle)};
}

Matrix3f map_axes(const Vector3f& towards) {
    Matrix3f axes;
    axes.row(0) = towards.unitOrthogonal().transpose();
    axes.row(1) = towards.cross(axes.row(0).transpose()).transpose();
    axes.row(2) = towards.transpose();
    return axes;
}

class DepthMap {
  public:
    DepthMap(const NodesF& places, const std::vector<Triangle>& casters, const Vector3f& towards)
        : axes_(map_axes(towards)), depth_(std::size_t(kMapSide) * kMapSide, -1e9f) {
        for (const auto& [a, b, c] : casters) {
            cast(project(places.row(a)), project(places.row(b)), project(places.row(c)));
        }
    }

    bool lit(const Vector3f& place, float bias) const {
        const Vector3f p = project(place);
        const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
        if (p.x() < 0 || p.y() < 0 || x >= kMapSide || y >= kMapSide) return true;
        return p.z() + bias >= depth_[std::size_t(y) * kMapSide + x];
    }

  private:
    Vector3f project(const Vector3f& place) const {
        const Vector3f p = axes_ * (place - kMiddle);
        constexpr float kScale = kMapSide / (2 * kExtent);
        return {p.x() * kScale + kMapSide / 2, p.y() * kScale + kMapSide / 2, p.z()};
    }

    void cast(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
        const float area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
        if (std::abs(area) < 1e-9f) return;
        const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
        const auto [low, high] = std::minmax({a.y(), b.y(), c.y()});
        const int x0 = std::max(0, int(std::ceil(left - 0.5f))),
                  x1 = std::min(kMapSide - 1, int(right - 0.5f));
        const int y0 = std::max(0, int(std::ceil(low - 0.5f))), y1 = std::min(kMapSide - 1, int(high - 0.5f));
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                const float px = x + 0.5f - a.x(), py = y + 0.5f - a.y();
                const float s = (px * (c.y() - a.y()) - py * (c.x() - a.x())) / area;
                const float t = ((b.x() - a.x()) * py - (b.y() - a.y()) * px) / area;
                if (s < 0 || t < 0 || s + t > 1) continue;
                float& depth = depth_[std::size_t(y) * kMapSide + x];
                depth = std::max(depth, a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
            }
        }
    }

    Matrix3f axes_;
    std::vector<float> depth_;
};

}  // namespace

std::vector<float> openness(const Face& face, const std::vector<Triangle>& casters, const TexelGrid& grid) {
    const NodesF places = face.rest.cast<float>();
    std::vector<float> open(grid.texels.size(), 0), weight(grid.texels.size(), 0);
    for (int k = 0; k < kDirections; ++k) {
        const Vector3f towards = direction(k);
        const DepthMap map(places, casters, towards);
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
