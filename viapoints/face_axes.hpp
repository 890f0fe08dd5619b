// Where the axes of a recording point to on the face: one of the 24 turns onto axes, the one that lays the
// points' rest best on the talker's (least squares with free scale); or the best turn of all [Horn87]; or
// what is given.
#pragma once

#include <string>

#include "viapoints/layout.hpp"

namespace viaface {

struct FaceAxes {
    Eigen::Matrix3d head_from_file = Eigen::Matrix3d::Identity();
    std::string name;        // where x, y and z point to: "forward,left,up"; or "fit"
    double fit_degrees = 0;  // how far the best turn of all is from head_from_file
};

// axes: "found", "fit", or as FaceAxes::name; left-handed ones may be given. up_axis: the file's axis that
// points up, "+Z", where the file tells. InputError("--axes", ...) for others, and where no turn is clearly
// best.
FaceAxes face_axes(const Configuration& rest, const Configuration& talker_rest, const std::string& axes,
                   const std::string& up_axis = "");

}  // namespace viaface
