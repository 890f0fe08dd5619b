// From where the face is seen, and what of it: picture size, the turn of the head, the camera, background;
// and the matrices that follow. The camera stands still in front of the head and the lights stand with it;
// the head turns about a pivot in the skull. The world is the head frame at zero angles (mm, x to the
// talker's left, y up, z to the camera).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace viaface {

using Rgb = std::array<std::uint8_t, 3>;  // sRGB

enum class Shown : std::uint8_t {
    kFull,
    kLowerFace,  // what is nearer to the mouth than to the eyes
    kLips,       // lips, mouth and jaw
    kPoints,     // the markers alone, as dots
    kWireframe   // the mesh as lines, hidden ones left out
};

struct View {
    static constexpr int kSmallest = 16, kLargest = 4096;  // pixels, either side
    static constexpr double kWidestTurn = 180;             // degrees, either way
    static constexpr double kNarrowestField = 4, kWidestField = 60;
    static constexpr double kSmallestScale = 0.1, kLargestScale = 50;  // px per mm

    int width = 512, height = 512;  // pixels
    double yaw = 0;                 // degrees, > 0 towards the talker's left, the picture's right
    double tilt = 0;                // degrees, > 0 lifts the chin
    double roll = 0;                // degrees, > 0 counter-clockwise in the picture
    double field_of_view = 17;      // degrees over the shorter side; head and shoulders fill it at any value
    std::optional<Rgb> background = {};  // none: a soft grey glow; black behind points, white behind lines
    Shown shown = Shown::kFull;
    bool orthographic = false;             // seen along parallel lines; the field of view is without effect
    std::optional<double> px_per_mm = {};  // everywhere if orthographic, else at the depth of the picture's
                                           // middle; none: what is shown fills the picture
    bool texture = true;                   // false: each material in one colour
    bool eyes_occluded = false;            // by a black bar
};

// InputError naming "size", "yaw", "tilt", "roll", "field_of_view" or "px_per_mm".
void check(const View& view);

inline constexpr std::array<std::string_view, 5> kShownNames = {"full", "lower-face", "lips", "points",
                                                                "wireframe"};
Shown shown_of(std::string_view name);  // InputError("show", ...) unless one of kShownNames

// "#rrggbb" or one of black, white, grey, green, blue; InputError("background", ...) otherwise.
Rgb parse_background(std::string_view text);

struct Camera {
    Eigen::Matrix4d world_from_head;
    Eigen::Matrix4d clip_from_world;
    Eigen::Vector3d place;  // world, mm; far in front if orthographic
    bool orthographic = false;
};
Camera camera_of(const View& view);

// Size of a pixel in the middle of the head, mm.
double pixel_size(const View& view);

}  // namespace viaface
