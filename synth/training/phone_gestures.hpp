// What a talker's face aims at in each phone: the one table of the gestural model. Ten channels, in mm; each
// has a target, a dominance (how strongly the phone insists on it where neighbours differ) and a time
// constant (how far its pull reaches beyond the phone).
//
// Sources. Dominance per phone and channel, blended by weight: [CohenMassaro93]. Gestures as targets of
// aperture, protrusion and constriction degree, blended where they overlap: [SaltzmanMunhall89]. Closing lips
// aim past contact (a virtual negative aperture) and are near peak velocity when they touch:
// [LofqvistGracco97]. The jaw is high and insistent in sibilants, low in open vowels, free in velars and /h/:
// [KeatingLindblomLubkerKreiman94]. Rounding: /u w/ protrude and narrow most and close the lips, /sh ch/
// protrude with open lips, unrounded phones leave them open; it is anticipated through phones that do not
// insist [Perkell92]. English /i u e o/ glide towards their end. Targets are of the size that such
// measurements report for an adult talker; they are fitted to no recording.
#pragma once

#include <array>
#include <span>

#include "viapoints/phones.hpp"

namespace viaface {

enum Channel : int {
    kJaw,         // drop of the lower incisors
    kUpperLip,    // rise of the upper lip's inner edge
    kLowerLip,    // rise of the lower lip's inner edge, in the head frame: the jaw's share is included
    kWidth,       // growth of the mouth's width at the border's corners
    kProtrusion,  // of the border, mean of upper and lower lip, forward; the jaw's swing apart
    kTuck,        // of the lower lip's edge under the upper incisors, backward
    kTipHeight,   // tongue, in the head frame: the jaw's share is included
    kTipAdvance,
    kBodyHeight,
    kBodyAdvance
};
inline constexpr int kChannels = 10;

struct Gesture {
    double target;  // mm from rest
    double
        dominance;    // 1 is a stressed vowel's; kInstant and more: a closure, which pulls at an instant only
    double reach_ms;  // the pull falls to 1/e at this distance from the phone (from the instant of a closure)
};
inline constexpr double kInstant = 8;

using Gestures = std::array<Gesture, kChannels>;

std::span<const Gestures> gestures_of(
    PhoneId phone);  // one, or two one after the other where the phone glides

}  // namespace viaface
