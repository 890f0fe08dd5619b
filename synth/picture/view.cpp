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
const Vector3d kTarget(0, 41, -106);             // mm: the middle of a square picture
constexpr double kShown = 282;                   // mm over the shorter side, at the target
constexpr double kCameraBelow = 0.0116;          // of its distance, below the target
constexpr double kNearer = 300, kFarther = 300;  // mm around the target that can be seen

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

void check_angle(const char* field, double value, double low, double high, const char* allowed) {
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
    check_angle("yaw", view.yaw, -View::kWidestTurn, View::kWidestTurn, "-180 to 180 degrees");
    check_angle("tilt", view.tilt, -View::kWidestTurn, View::kWidestTurn, "-180 to 180 degrees");
    check_angle("roll", view.roll, -View::kWidestTurn, View::kWidestTurn, "-180 to 180 degrees");
    check_angle("field_of_view", view.field_of_view, View::kNarrowestField, View::kWidestField,
                "4 to 60 degrees");
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
    const double slope = std::tan(radians(view.field_of_view / 2));
    const double distance = kShown / 2 / slope;
    const double shorter = std::min(view.width, view.height);
    // A tall picture keeps the shoulders at its lower edge and has its room above the head.
    const double lift = kShown / 2 * (view.height / shorter - 1);
    const Vector3d target = kTarget + Vector3d(0, lift, 0);
    const Vector3d place = target + Vector3d(0, -kCameraBelow * distance, distance);
    const double near = std::max(distance - kNearer, distance / 20);
    return {
        turn_of(view),
        perspective(slope * view.width / shorter, slope * view.height / shorter, near, distance + kFarther) *
            look_at(place, target),
        place};
}

double pixel_size(const View& view) { return kShown / std::min(view.width, view.height); }

}  // namespace viaface
