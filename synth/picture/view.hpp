// From where the face is seen: picture size, the turn of the head, background; and the matrices that follow.
// The camera stands still in front of the head and the lights stand with it; the head turns about a pivot in
// the skull. The world is the head frame at zero angles (mm, x to the talker's left, y up, z to the camera).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace viaface {

using Rgb = std::array<std::uint8_t, 3>;  // sRGB

struct View {
    static constexpr int kSmallest = 16, kLargest = 4096;  // pixels, either side
    static constexpr double kWidestTurn = 180;             // degrees, either way
    static constexpr double kNarrowestField = 4, kWidestField = 60;

    int width = 512, height = 512;  // pixels
    double yaw = 0;                 // degrees, > 0 towards the talker's left, the picture's right
    double tilt = 0;                // degrees, > 0 lifts the chin
    double roll = 0;                // degrees, > 0 counter-clockwise in the picture
    double field_of_view = 17;      // degrees over the shorter side; head and shoulders fill it at any value
    std::optional<Rgb> background = {};  // none: a soft grey gradient
};

// InputError naming "size", "yaw", "tilt", "roll" or "field_of_view".
void check(const View& view);

// "#rrggbb" or one of black, white, grey, green, blue; InputError("background", ...) otherwise.
Rgb parse_background(std::string_view text);

struct Camera {
    Eigen::Matrix4d world_from_head;
    Eigen::Matrix4d clip_from_world;
    Eigen::Vector3d place;  // world, mm
};
Camera camera_of(const View& view);

// Size of a pixel in the middle of the head, mm.
double pixel_size(const View& view);

}  // namespace viaface
