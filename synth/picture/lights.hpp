// The lights, which stand with the camera: unit directions in the world and their linear colours. Plain
// numbers, as the rasteriser's kernels read them too.
#pragma once

namespace viaface::lights {

inline constexpr float kKeyWay[3] = {-0.500f, 0.636f, 0.588f}, kFillWay[3] = {0.768f, 0.144f, 0.624f},
                       kRimWay[3] = {0.640f, 0.427f, -0.640f};
inline constexpr float kKey[3] = {2.10f, 1.90f, 1.69f}, kFill[3] = {0.29f, 0.29f, 0.32f},
                       kRim[3] = {1.0f, 1.05f, 1.2f};
inline constexpr float kGround[3] = {0.098f, 0.080f, 0.075f}, kSky[3] = {0.30f, 0.32f, 0.37f};

}  // namespace viaface::lights
