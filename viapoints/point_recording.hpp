// What a motion file of any kind holds before it is a Motion: labelled points in the file's own axes. Readers
// (point_csv.hpp, motion_trc.hpp, motion_c3d.hpp) convert to mm and mark what was not measured as NaN;
// nothing becomes 0. point_names.hpp brings labels to the layout.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

inline constexpr std::size_t kMotionFileBytes = 512u << 20;
inline constexpr std::size_t kMotionFileSamples = 2'000'000;
inline constexpr std::size_t kMotionFilePoints = 4096;
inline constexpr double kFarthestPoint_mm = 1e6;  // from the file's origin

struct PointRecording {
    std::vector<double> time_s;       // strictly rising
    std::vector<std::string> labels;  // each once
    RowMatrix positions;              // [samples x 3*labels], mm, the file's axes; NaN where not measured
    RowMatrix residuals;  // [samples x labels], mm, as the file's maker measured; empty: none kept
    std::vector<ExtraColumn> extra = {};
    std::vector<std::string> comments = {};
    std::vector<std::string> remarks = {};     // what the reader found odd, for people
    std::string x_screen = {}, y_screen = {};  // of a C3D: the axis to the right and up on its maker's screen
    bool head_frame = false;  // the file says that its points are a talker's, in his head frame

    std::size_t size() const { return time_s.size(); }
};

// mm per unit: "mm", "cm", "m" and their English names in any case; none for others.
std::optional<double> millimetres_per(std::string_view unit);

// The label, or "label (2)" and so on when it is taken.
std::string unused_label(const std::vector<std::string>& taken, std::string_view label);

}  // namespace viaface
