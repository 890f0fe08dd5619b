// The gestural model: phones with times to the motion of the channels of phone_gestures.hpp. A training
// program performs recitations with it; nothing of it is linked into what speaks.
//
// Each channel x(t) minimises
//     sum over gestures of integral D(t) (x - target)^2 dt + a^2 integral x'^2 dt + b^6 integral x'''^2 dt,
// where D(t) is the gesture's dominance within its window and falls off as a Gaussian of its reach outside.
// The last term is the minimum-jerk principle [FH85]; the middle one keeps x between its targets; the sum of
// pulls makes neighbours coarticulate by dominance [CohenMassaro93], departing from their ratio of negative
// exponentials, whose cusps no face follows. Windows begin and end `lead` before their phone: lips lead the
// sound.
#pragma once

#include "synth/training/phone_gestures.hpp"
#include "viapoints/motion.hpp"

namespace viaface {

inline constexpr double kGestureRate = 200;  // Hz

struct ChannelMotion {
    std::vector<double> time_s;  // k / kGestureRate, from 0 to the last phone's end or just past it
    RowMatrix channels;          // [samples x kChannels], mm from rest
};

// Of the face at rest, lips together: the pause's targets, where every motion begins and ends.
std::array<double, kChannels> resting_channels();

// std::invalid_argument for an empty sequence.
ChannelMotion gesture(const PhoneSequence& phones);

}  // namespace viaface
