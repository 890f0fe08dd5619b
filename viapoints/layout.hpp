// The marker layout: 38 named points of a face, 114 numbers. The one table is LAYOUT.md; a test holds the two
// together. [ATR98, Figure 1a] for the 18 face markers, [Basu98, section 6] for the 16 lip points. Head
// frame: right-handed, mm, x to the talker's left, y up, z forward, origin midway between the upper incisors'
// edges at rest.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace viaface {

inline constexpr int kPoints = 38;
inline constexpr int kCoordinates = 3 * kPoints;

inline constexpr int kFaceMarkers = 18;  // points 0..17
inline constexpr int kFirstLipPoint =
    18;  // points 18..33: 8 on the vermilion border, then 8 on the inner edge
inline constexpr int kLipPoints = 16;

enum Point : int {
    // face markers; the outer lip ring runs from the top towards the talker's left and round
    kLipTop,
    kLipTopLeft,
    kLipCornerLeft,
    kLipBottomLeft,
    kLipBottom,
    kLipBottomRight,
    kLipCornerRight,
    kLipTopRight,
    kChin,
    kChinLeft,
    kChinRight,
    kJawLeft,
    kJawRight,
    kCheekLowerLeft,
    kCheekLowerRight,
    kCheekUpperLeft,
    kCheekUpperRight,
    kNose,
    // lip points: border, then inner edge, each from the top towards the talker's left and round
    kBorderTop,
    kBorderTopLeft,
    kBorderLeft,
    kBorderBottomLeft,
    kBorderBottom,
    kBorderBottomRight,
    kBorderRight,
    kBorderTopRight,
    kInnerTop,
    kInnerTopLeft,
    kInnerLeft,
    kInnerBottomLeft,
    kInnerBottom,
    kInnerBottomRight,
    kInnerRight,
    kInnerTopRight,
    // inside
    kLowerIncisor,
    kTongueTip,
    kTongueBody,
    kTongueRear
};

std::string_view point_name(int index);                 // "lip_top"; index in [0, kPoints)
std::optional<int> point_index(std::string_view name);  // none when the layout has no such point
int mirrored_point(int index);                          // the same place on the other side of the face

// Positions of all points at one instant: x0 y0 z0 x1 ... [114], mm, head frame; NaN where not measured.
using Configuration = Eigen::Matrix<double, kCoordinates, 1>;

inline Eigen::Vector3d point_of(const Configuration& c, int point) { return c.segment<3>(3 * point); }

}  // namespace viaface
