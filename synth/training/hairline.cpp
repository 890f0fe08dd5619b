#include "synth/training/hairline.hpp"

#include <algorithm>
#include <cmath>

#include "synth/training/bake_noise.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

// The hairline seen from above the middle of the skull: height over the azimuth from straight ahead.
struct HairlinePoint {
    float azimuth, height;  // degrees, mm
};
constexpr HairlinePoint kHairline[] = {{0, 134},  {12, 135}, {24, 137},  {34, 133},  {42, 121}, {49, 106},
                                       {57, 93},  {64, 78},  {70, 60},   {75, 54},   {80, 70},  {92, 88},
                                       {104, 76}, {116, 26}, {128, -12}, {145, -24}, {180, -28}};
const Vector3f kSkullMiddle(0, 0, -106);

float between_points(float azimuth) {
    const auto* after = std::ranges::find_if(kHairline, [&](const auto& p) { return p.azimuth >= azimuth; });
    if (after == std::begin(kHairline)) return after->height;
    const auto* before = after - 1;
    return mix(before->height, after->height,
               (azimuth - before->azimuth) / (after->azimuth - before->azimuth));
}

// Rounded over `half` degrees to either side.
float hairline_height(float azimuth) {
    constexpr float half = 5;
    float sum = 0;
    for (int k = -2; k <= 2; ++k) sum += between_points(std::clamp(azimuth + k * half / 2, 0.0f, 180.0f));
    return sum / 5;
}

}  // namespace

float hair_depth(const Vector3f& p) {
    const Vector3f d = p - kSkullMiddle;
    const float radius = std::hypot(d.x(), d.z());
    const float azimuth = std::atan2(std::abs(d.x()), d.z()) * 57.29578f;
    const float line = hairline_height(azimuth);
    const float slope =
        (hairline_height(std::min(azimuth + 4, 180.0f)) - hairline_height(std::max(azimuth - 4, 0.0f))) /
        std::max(radius * 0.1396f, 4.0f);
    const float ragged = 8 * (fractal(p * 0.09f, 2) - 0.5f) + 3 * (noise(p * 0.35f) - 0.5f);
    float depth = (p.y() - line) / std::sqrt(1 + slope * slope) + ragged;
    const float ear = smooth_step(76, 80, std::abs(p.x())) * smooth_step(88, 76, p.y());
    return mix(depth, -20, ear);
}

float hair_thickness(const Vector3f& p) {
    constexpr float kThickness = 2.8f, kFrom = 2, kFull = 34;  // mm
    constexpr float kCrownFrom = 110, kCrown = 172;            // mm up: there it lies flat
    return kThickness * smooth_step(kFrom, kFull, hair_depth(p)) *
           (1 - 0.85f * smooth_step(kCrownFrom, kCrown, p.y()));
}

}  // namespace viaface
