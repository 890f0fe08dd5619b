// A performance of blend shapes as motion of the talker's points:
//   p(t) = p_rest + sum over shapes s of w_s(t) d_s,  d_s = points(rest + delta_s) - points(rest),
// where points() reads the layout's points off a mesh as Poser::drawn_points does, and delta_s is the
// talker's own shape of that name, at full scale. Lips, teeth and tongue do not meet here: commanded points
// may lie beyond contact, as a bilabial's do; the pose lets them touch.
//
// Names match in any case and with sides spelt either way: MouthSmileLeft is mouthSmile_L. A shape without a
// side moves both sides of a talker that has them apart (browInnerUp). mouthClose shuts what jawOpen has
// opened and nothing else: its weight counts up to that of jawOpen.
#pragma once

#include "synth/motion/blend_recording.hpp"
#include "synth/pose/pose.hpp"

namespace viaface {

// A recorded shape that moved nothing, because the talker has none of that name.
struct LackingShape {
    std::string name;
    double largest = 0;  // of its weights, by size
};

struct Retargeted {
    Motion motion;  // extra: that of the recording, and the blinks recorded (eyeBlink_L, eyeBlink_R)
    std::vector<LackingShape> lacking;  // largest first, those never used left out
};

// std::invalid_argument when names and weights of the recording differ in number.
Retargeted retarget(const Face& face, const Poser& poser, const BlendRecording& recording);

}  // namespace viaface
