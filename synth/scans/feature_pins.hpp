// Where features of the generic head belong on an aligned scan, and the field morphing that carries the rest.
// [ATR98, "Face and lip mesh adaptation"; BeierNeely92]
#pragma once

#include <map>
#include <string>

#include "facemodel/smooth_fit.hpp"
#include "synth/scans/generic_head.hpp"
#include "synth/scans/similarity.hpp"

namespace viaface {

// The place at rest of a face marker, a lip point (viapoints/LAYOUT.md), or eye_left_inner, eye_left_outer,
// eye_right_inner, eye_right_outer. InputError("landmarks", ...) for another name.
Eigen::Vector3d generic_landmark(const GenericHead& generic, const std::string& name);

// Lids, border and meeting line of the lips, from the picture of the scan, and landmarks that are given.
std::vector<Pin> feature_pins(const GenericHead& generic, const PaintedSurface& scan,
                              const std::map<std::string, Eigen::Vector3d>& landmarks,
                              const Similarity& from_scan, std::vector<std::string>& remarks);

// All nodes of the generic face, moved by the field between the pins' contours in the unrolled plane of the
// cylinder; fading out from the face towards ears and throat.
Nodes field_morphed(const GenericHead& generic, const std::vector<Pin>& pins);

}  // namespace viaface
