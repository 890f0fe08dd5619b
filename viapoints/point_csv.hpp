// Points as CSV by anybody: '#' comments, one header, one line per sample. The first column is the time:
// time_s, t_s, time, t or time_ms in any case. Three columns NAME_x_mm, NAME_y_mm, NAME_z_mm (or _cm, _m, or
// no unit, which then has to be given) are a point, wherever they stand; other columns are kept. An empty
// cell or nan is missing. A file as motion_csv.hpp writes it, with time_s and points of the layout in mm, is
// in a talker's head frame unless a comment says kAnotherPerson.
#pragma once

#include <string>
#include <string_view>

#include "viapoints/point_recording.hpp"

namespace viaface {

inline constexpr std::string_view kAnotherPerson = "points of another person, in his own axes";

// unit: of the columns that name none; empty: they are refused. InputError names the line and the column in
// its field.
PointRecording parse_point_csv(std::string_view text, const std::string& field = "motion",
                               const std::string& unit = "");

}  // namespace viaface
