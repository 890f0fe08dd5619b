// Takes of FACEGOOD's Audio2Face: a table of frames x 116 weights at 30 frames per second. Two facts come
// from the take's own project (github.com/FACEGOOD/FACEGOOD-Audio2Face, MIT): the curves' names, in the order
// of its list (column k of a take is named by entry k - 1 of the list, column 0 by the last), and which of
// them stand for a shape of ARKit (its table Voice2Face_blendshape2ARkit: where several do, the largest is
// taken). Curves that the table leaves out keep their own names.
#pragma once

#include "synth/motion/blend_recording.hpp"

namespace viaface {

inline constexpr int kFacegoodCurves = 116;
inline constexpr double kFacegoodRate = 30;  // frames per second

// InputError(field, ...) for a table of another width, and for a weight that is none, with its place.
BlendRecording facegood_recording(const RowMatrix& curves, const std::string& field = "motion");

}  // namespace viaface
