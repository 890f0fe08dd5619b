// Value noise on a lattice, seeded by its place alone.
#pragma once

#include <Eigen/Core>

namespace viaface {

float lattice(int x, int y, int z);                            // 0 to 1
float noise(const Eigen::Vector3f& place);                     // 0 to 1, lattice of side 1
float fractal(const Eigen::Vector3f& place, int octaves = 4);  // about 0 to 1, mean near 0.5

inline float clamp01(float x) { return x < 0 ? 0 : x > 1 ? 1 : x; }
inline float smooth_step(float low, float high, float x) {
    const float t = clamp01((x - low) / (high - low));
    return t * t * (3 - 2 * t);
}
inline float mix(float a, float b, float share) { return a + (b - a) * share; }
inline Eigen::Vector3f mix(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float share) {
    return a + (b - a) * share;
}

}  // namespace viaface
