// From the labels of a recording to points of the layout. A label is looked up, in any case and without what
// stands before a colon ("subject:chin"), in the map given, among the layout's names, and in this table of
// what laboratories call the same places:
//
//   UL upper_lip -> border_top      LL lower_lip -> border_bottom    ML mouth_left -> lip_corner_left
//   MR mouth_right -> lip_corner_right    JAW LI -> lower_incisor    TT -> tongue_tip    TB -> tongue_body
//   TR TD -> tongue_rear
//
// What has no place in the layout is kept as extra columns NAME_x_mm, NAME_y_mm, NAME_z_mm in the file's
// axes.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "viapoints/point_recording.hpp"

namespace viaface {

using NameMap = std::map<std::string, std::string>;  // label -> name of the layout, or empty: kept as another

// Lines of label=name; '#' comments. InputError names the line.
NameMap parse_name_map(std::string_view text, const std::string& field = "--map");

struct LaidOut {
    Motion motion;                                           // the file's axes, mm
    std::vector<std::pair<std::string, std::string>> named;  // label, name of the layout
    std::vector<std::string> others;                         // labels kept as extra columns
};

// InputError(field, ...) when two labels mean one point, the map names labels that are not there, or nothing
// has a place in the layout.
LaidOut lay_out(const PointRecording& recording, const NameMap& map = {},
                const std::string& field = "motion");

// The layout's points as a recording with labels, to be written; points that were never measured left out.
PointRecording labelled(const Motion& motion);

}  // namespace viaface
