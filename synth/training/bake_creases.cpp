#include "synth/training/bake_creases.hpp"

#include <algorithm>
#include <cmath>

#include "synth/training/bake_noise.hpp"

namespace viaface {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kSteps = 12;   // of a bow
constexpr float kReach = 3;  // half widths

}  // namespace

Creases::Creases(const Landmarks& landmarks, float age) : age_(age) {
    if (age == 0) return;
    const auto mark = [&](int k, float x, float y) {
        const Eigen::Vector3d& place = landmarks[static_cast<std::size_t>(k)];
        return Vector2f(static_cast<float>(place.x()) + x, static_cast<float>(place.y()) + y);
    };
    for (const float side : {-1.0f, 1.0f}) {
        const bool left = side > 0;
        const int wing = left ? 35 : 31, corner = left ? 54 : 48, outer = left ? 45 : 36,
                  inner = left ? 42 : 39, under = left ? 46 : 41;
        add(mark(wing, side * 5, 7), mark(wing, side * 17, -3), mark(corner, side * 9, -7), 1.5f, 0.9f);
        add(mark(corner, side * 1, -3), mark(corner, side * 4, -10), mark(corner, side * 2, -18), 1.7f,
            0.22f);
        add(mark(outer, side * 5, 5), mark(outer, side * 12, 7), mark(outer, side * 17, 12), 0.7f, 0.5f);
        add(mark(outer, side * 6, 0), mark(outer, side * 13, 0), mark(outer, side * 19, 1), 0.7f, 0.6f);
        add(mark(outer, side * 4, -5), mark(outer, side * 10, -9), mark(outer, side * 16, -11), 0.7f, 0.5f);
        add(mark(inner, side * 1, -6), mark(under, 0, -12), mark(outer, side * 1, -9), 1.3f, 0.6f);
        add(mark(27, side * 5, 1), mark(27, side * 7, 9), mark(27, side * 5, 17), 0.9f, 0.45f);
        for (int k = 0; k < 3; ++k) {
            const float up = 17 + 9.5f * static_cast<float>(k);
            add(mark(27, 0, up - 1), mark(27, side * 20, up + 4), mark(27, side * (44 - 3.0f * k), up - 1),
                1.0f, 0.5f - 0.08f * static_cast<float>(k));
        }
    }
}

void Creases::add(const Vector2f& from, const Vector2f& over, const Vector2f& to, float half_width,
                  float depth) {
    Line line{{}, half_width, depth, from, from};
    for (int k = 0; k <= kSteps; ++k) {
        const float t = static_cast<float>(k) / kSteps;
        line.bow.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * over + t * t * to);
        line.low = line.low.cwiseMin(line.bow.back());
        line.high = line.high.cwiseMax(line.bow.back());
    }
    line.low.array() -= kReach * half_width;
    line.high.array() += kReach * half_width;
    lines_.push_back(std::move(line));
}

float Creases::of(const Line& line, const Vector2f& p) {
    if ((p.array() < line.low.array()).any() || (p.array() > line.high.array()).any()) return 0;
    float nearest = 1e9f, along = 0;
    for (int k = 0; k < kSteps; ++k) {
        const Vector2f &a = line.bow[static_cast<std::size_t>(k)],
                       way = line.bow[static_cast<std::size_t>(k) + 1] - a;
        const float t = clamp01((p - a).dot(way) / way.squaredNorm());
        const float distance = (p - a - t * way).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        along = (static_cast<float>(k) + t) / kSteps;
    }
    const float ends = smooth_step(0, 0.15f, along) * smooth_step(1, 0.7f, along);
    const float off = nearest / line.half_width;
    return line.depth * ends * std::exp(-off * off);
}

float Creases::at(const Vector3f& p) const {
    constexpr float kBehind = -75;  // mm: no face there
    if (lines_.empty() || p.z() < kBehind) return 0;
    const Vector2f wavering =
        p.head<2>() + Vector2f(1.1f * (noise(p * 0.12f) - 0.5f), 2.2f * (noise(p * 0.09f) - 0.5f));
    float deepest = 0;
    for (const Line& line : lines_) deepest = std::max(deepest, of(line, wavering));
    return age_ * deepest * (0.7f + 0.5f * noise(p * 0.2f));
}

}  // namespace viaface
