#include "synth/training/hairline.hpp"

#include <algorithm>
#include <cmath>

#include "synth/training/bake_noise.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

// The hairline seen from above the middle of the skull: height over the azimuth from straight ahead, of short
// hair and of an oval brow.
struct HairlinePoint {
    float azimuth, height, oval;  // degrees, mm, mm
};
constexpr HairlinePoint kHairline[] = {
    {0, 134, 137}, {12, 135, 137}, {24, 137, 135},  {34, 133, 130},  {42, 121, 124}, {49, 106, 117},
    {57, 93, 109}, {64, 78, 102},  {70, 60, 96},    {75, 54, 92},    {80, 66, 88},   {92, 82, 82},
    {104, 66, 66}, {116, 12, 12},  {128, -20, -20}, {145, -26, -26}, {180, -28, -28}};
const Vector3f kSkullMiddle(0, 0, -106);

float between_points(float oval, float azimuth) {
    const auto* after = std::ranges::find_if(kHairline, [&](const auto& p) { return p.azimuth >= azimuth; });
    const auto height = [&](const HairlinePoint& p) { return mix(p.height, p.oval, oval); };
    if (after == std::begin(kHairline)) return height(*after);
    const auto* before = after - 1;
    return mix(height(*before), height(*after),
               (azimuth - before->azimuth) / (after->azimuth - before->azimuth));
}

// Rounded over `half` degrees to either side.
float hairline_height(const HairStyle& style, float azimuth) {
    constexpr float half = 5;
    float sum = 0;
    for (int k = -2; k <= 2; ++k)
        sum += between_points(style.oval, std::clamp(azimuth + k * half / 2, 0.0f, 180.0f));
    return sum / 5 + style.forehead * smooth_step(34, 12, azimuth) +
           style.temples * smooth_step(16, 36, azimuth) * smooth_step(64, 50, azimuth);
}

}  // namespace

float hair_depth(const HairStyle& style, const Vector3f& p) {
    const Vector3f d = p - kSkullMiddle;
    const float radius = std::hypot(d.x(), d.z());
    const float azimuth = std::atan2(std::abs(d.x()), d.z()) * 57.29578f;
    const float line = hairline_height(style, azimuth);
    const float slope = (hairline_height(style, std::min(azimuth + 4, 180.0f)) -
                         hairline_height(style, std::max(azimuth - 4, 0.0f))) /
                        std::max(radius * 0.1396f, 4.0f);
    const float ragged = style.ragged * (8 * (fractal(p * 0.09f, 2) - 0.5f) + 3 * (noise(p * 0.35f) - 0.5f));
    float depth = (p.y() - line) / std::sqrt(1 + slope * slope) + ragged;
    const float ear = smooth_step(76, 80, std::abs(p.x())) * smooth_step(88, 76, p.y());
    return mix(depth, -20, ear);
}

float hair_thickness(const HairStyle& style, const Vector3f& p) {
    constexpr float kFrom = 2;                       // mm behind the line
    constexpr float kCrownFrom = 110, kCrown = 172;  // mm up
    return style.thickness * smooth_step(kFrom, style.full_at, hair_depth(style, p)) *
           (1 - style.flat_crown * smooth_step(kCrownFrom, kCrown, p.y()));
}

// Hairs lie on half planes about the axis from the skull's middle to the knot; these meet under it.
Vector3f strand_place(const HairStyle& style, const Vector3f& p) {
    if (!style.knot) return p;
    constexpr float kRadius = 55, kAlong = 0.10f;  // mm to a radian, and of that
    const Vector3f middle(0, 60, -106);
    const Vector3f axis = (style.knot->middle - middle).normalized(), from = p - middle;
    const Vector3f up(0, -axis.z(), axis.y());
    const float round = std::atan2(from.x(), from.dot(up)), away = std::acos(from.normalized().dot(axis));
    return {kRadius * round, kRadius * kAlong * away, 17};
}

}  // namespace viaface
