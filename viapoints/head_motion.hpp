// The head's rigid motion, taken out of a recording by the quaternion method [Horn87] (rigid_turn.hpp) from
// markers that move with the skull alone. The markers' shape is the mean of their places, each frame laid
// on the first by its own turn; a frame's turn and shift carry that shape onto the frame's markers, and the
// rms distance left is the frame's residual. At least three markers, not on a line, must be seen in every
// frame.
#pragma once

#include <string>
#include <vector>

#include "viapoints/point_recording.hpp"
#include "viapoints/rigid_turn.hpp"

namespace viaface {

struct HeadMotion {
    std::vector<std::string> markers;  // labels
    std::vector<RigidTurn> frames;     // [samples]: where the head of the first frame has gone
    double residual_mm = 0;            // rms over the frames
    double widest_turn_degrees = 0, farthest_shift_mm = 0;  // of the markers' middle
};

// Labels of the points whose distances from each other change least: the three that keep them best, and all
// that keep theirs to these within twice as much and kMarkerNoise. InputError when no three do within 1 mm
// rms.
inline constexpr double kMarkerNoise = 0.2;  // mm
std::vector<std::string> least_moving(const PointRecording& recording, const std::string& field = "motion");

// InputError("--head-markers", ...) for unknown or too few markers, or a frame that sees too few of them.
HeadMotion head_motion(const PointRecording& recording, const std::vector<std::string>& markers);

// The same points as the head of the first frame holds them.
PointRecording without_head(PointRecording recording, const HeadMotion& head);

}  // namespace viaface
