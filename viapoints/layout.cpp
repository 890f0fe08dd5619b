#include "viapoints/layout.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace viaface {
namespace {

constexpr std::array<std::string_view, kPoints> kNames = {"lip_top",
                                                          "lip_top_left",
                                                          "lip_corner_left",
                                                          "lip_bottom_left",
                                                          "lip_bottom",
                                                          "lip_bottom_right",
                                                          "lip_corner_right",
                                                          "lip_top_right",
                                                          "chin",
                                                          "chin_left",
                                                          "chin_right",
                                                          "jaw_left",
                                                          "jaw_right",
                                                          "cheek_lower_left",
                                                          "cheek_lower_right",
                                                          "cheek_upper_left",
                                                          "cheek_upper_right",
                                                          "nose",
                                                          "border_top",
                                                          "border_top_left",
                                                          "border_left",
                                                          "border_bottom_left",
                                                          "border_bottom",
                                                          "border_bottom_right",
                                                          "border_right",
                                                          "border_top_right",
                                                          "inner_top",
                                                          "inner_top_left",
                                                          "inner_left",
                                                          "inner_bottom_left",
                                                          "inner_bottom",
                                                          "inner_bottom_right",
                                                          "inner_right",
                                                          "inner_top_right",
                                                          "lower_incisor",
                                                          "tongue_tip",
                                                          "tongue_body",
                                                          "tongue_rear"};

}  // namespace

std::string_view point_name(int index) { return kNames.at(static_cast<std::size_t>(index)); }

std::optional<int> point_index(std::string_view name) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) return std::nullopt;
    return static_cast<int>(found - kNames.begin());
}

int mirrored_point(int index) {
    std::string name(point_name(index));
    if (const auto at = name.rfind("left"); at != std::string::npos) {
        name.replace(at, 4, "right");
    } else if (const auto other = name.rfind("right"); other != std::string::npos) {
        name.replace(other, 5, "left");
    }
    return point_index(name).value();
}

}  // namespace viaface
