// Motion in the TRC format of Motion Analysis, as OpenSim reads it: lines of cells between tabs,
//
//   PathFileType  4  (X/Y/Z)  name.trc
//   DataRate  CameraRate  NumFrames  NumMarkers  Units  ...
//   60  60  900  2  mm  ...
//   Frame#  Time  chin  (empty)  (empty)  nose
//   (empty)  (empty)  X1  Y1  Z1  X2  Y2  Z2
//
// then one line per frame: its number, its time in s, x y z of each marker. Empty cells are missing. Times
// count as written.
#pragma once

#include <string>
#include <string_view>

#include "viapoints/point_recording.hpp"

namespace viaface {

bool is_trc(std::string_view text);

// unit: what holds where the file names none; empty: such a file is refused. InputError names the line and
// the column in its field.
PointRecording parse_trc(std::string_view text, const std::string& field = "motion",
                         const std::string& unit = "");

// In mm. std::invalid_argument for shapes that disagree, InputError for a label with a tab in it.
std::string format_trc(const PointRecording& recording);

}  // namespace viaface
