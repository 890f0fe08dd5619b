#include "synth/picture/view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix4d;
using Eigen::Vector3d;

const Vector3d kPivot(0, 35, -106);              // mm: between the ears
const Vector3d kTarget(0, 43, -106);             // mm: the middle of a square picture
constexpr double kShown = 300;                   // mm over the shorter side, at the target
constexpr double kCameraBelow = 0.0116;          // of its distance, below the target
constexpr double kFarAway = 1e4;                 // mm: where an orthographic camera stands
constexpr double kNearer = 300, kFarther = 300;  // mm around the target that can be seen

// What is in the middle of the picture, head frame, and how many mm there are over the shorter side.
struct Framing {
    Vector3d middle;
    double shown;
    bool turns;  // the camera follows it when the head turns
};
Framing framing_of(const View& view) {
    Framing framing{kTarget, kShown, false};
    if (view.shown == Shown::kLowerFace) framing = {{0, -14, -25}, 160, true};
    if (view.shown == Shown::kLips) framing = {{0, -20, -20}, 120, true};
    if (view.px_per_mm) framing.shown = std::min(view.width, view.height) / *view.px_per_mm;
    return framing;
}

struct NamedColour {
    std::string_view name;
    Rgb colour;
};
constexpr NamedColour kColours[] = {{"black", {0, 0, 0}},
                                    {"white", {255, 255, 255}},
                                    {"grey", {128, 128, 128}},
                                    {"green", {0, 177, 64}},
                                    {"blue", {0, 71, 187}}};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

void check_range(const char* field, double value, double low, double high, const char* allowed) {
    if (!(value >= low && value <= high)) throw InputError(field, std::to_string(value), allowed);
}

Matrix4d perspective(double half_width, double half_height, double near, double far) {
    Matrix4d m = Matrix4d::Zero();
    m(0, 0) = 1 / half_width;
    m(1, 1) = 1 / half_height;
    m(2, 2) = -(far + near) / (far - near);
    m(2, 3) = -2 * far * near / (far - near);
    m(3, 2) = -1;
    return m;
}

Matrix4d parallel(double half_width, double half_height, double near, double far) {
    Matrix4d m = Matrix4d::Identity();
    m(0, 0) = 1 / half_width;
    m(1, 1) = 1 / half_height;
    m(2, 2) = -2 / (far - near);
    m(2, 3) = -(far + near) / (far - near);
    return m;
}

Matrix4d look_at(const Vector3d& from, const Vector3d& to) {
    const Vector3d back = (from - to).normalized();
    const Vector3d right = Vector3d::UnitY().cross(back).normalized();
    Matrix4d m = Matrix4d::Identity();
    m.block<1, 3>(0, 0) = right.transpose();
    m.block<1, 3>(1, 0) = back.cross(right).transpose();
    m.block<1, 3>(2, 0) = back.transpose();
    m.block<3, 1>(0, 3) = -m.block<3, 3>(0, 0) * from;
    return m;
}

Matrix4d turn_of(const View& view) {
    Matrix4d m = Matrix4d::Identity();
    m.block<3, 3>(0, 0) = (AngleAxisd(radians(view.roll), Vector3d::UnitZ()) *
                           AngleAxisd(-radians(view.tilt), Vector3d::UnitX()) *
                           AngleAxisd(radians(view.yaw), Vector3d::UnitY()))
                              .toRotationMatrix();
    m.block<3, 1>(0, 3) = kPivot - m.block<3, 3>(0, 0) * kPivot;
    return m;
}

}  // namespace

void check(const View& view) {
    for (const int side : {view.width, view.height}) {
        if (side < View::kSmallest || side > View::kLargest) {
            throw InputError("size", std::to_string(view.width) + "x" + std::to_string(view.height),
                             "16x16 to 4096x4096");
        }
    }
    check_range("yaw", view.yaw, -View::kWidestTurn, View::kWidestTurn, "-180 to 180 degrees");
    check_range("tilt", view.tilt, -View::kWidestTurn, View::kWidestTurn, "-180 to 180 degrees");
    check_range("roll", view.roll, -View::kWidestTurn, View::kWidestTurn, "-180 to 180 degrees");
    check_range("field_of_view", view.field_of_view, View::kNarrowestField, View::kWidestField,
                "4 to 60 degrees");
    if (view.px_per_mm)
        check_range("px_per_mm", *view.px_per_mm, View::kSmallestScale, View::kLargestScale,
                    "0.1 to 50 pixels per mm");
}

Shown shown_of(std::string_view name) {
    std::string allowed;
    for (std::size_t i = 0; i < kShownNames.size(); ++i) {
        if (name == kShownNames[i]) return static_cast<Shown>(i);
        allowed += (i == 0 ? "" : ", ") + std::string(kShownNames[i]);
    }
    throw InputError("show", std::string(name), allowed);
}

Rgb parse_background(std::string_view text) {
    for (const auto& [name, colour] : kColours) {
        if (text == name) return colour;
    }
    std::uint32_t number = 0;
    const bool shaped = text.size() == 7 && text[0] == '#';
    const auto [end, error] = std::from_chars(text.data() + shaped, text.data() + text.size(), number, 16);
    if (!shaped || error != std::errc{} || end != text.data() + text.size()) {
        throw InputError("background", std::string(text), "#rrggbb, black, white, grey, green or blue");
    }
    return {static_cast<std::uint8_t>(number >> 16), static_cast<std::uint8_t>(number >> 8 & 255),
            static_cast<std::uint8_t>(number & 255)};
}

Camera camera_of(const View& view) {
    check(view);
    const Framing framing = framing_of(view);
    const Matrix4d world_from_head = turn_of(view);
    const double slope = std::tan(radians(view.field_of_view / 2));
    const double distance = view.orthographic ? kFarAway : kShown / 2 / slope;
    const double shorter = std::min(view.width, view.height);
    Vector3d target = framing.middle;
    if (framing.turns) target = (world_from_head * target.homogeneous()).head<3>();
    // A tall picture keeps the shoulders at its lower edge and has its room above the head.
    if (framing.shown == kShown) target.y() += kShown / 2 * (view.height / shorter - 1);
    const double below = view.orthographic ? 0 : kCameraBelow;
    const Vector3d place = target + Vector3d(0, -below * distance, distance);
    const double near = std::max(distance - kNearer, distance / 20), far = distance + kFarther;
    const double half = view.orthographic ? framing.shown / 2 : slope * (framing.shown / kShown);
    const auto project = view.orthographic ? parallel : perspective;
    return {world_from_head,
            project(half * view.width / shorter, half * view.height / shorter, near, far) *
                look_at(place, target),
            place, view.orthographic};
}

double pixel_size(const View& view) { return framing_of(view).shown / std::min(view.width, view.height); }

}  // namespace viaface
