// The postures that are scanned to make a talker, as weights of the blend-shape head. [ATR98, "Static face
// scans" and Figure 2: five vowels and three non-speech postures] Departure: eight postures span neither a
// pressed /m/ nor a tucked /f/, so the talker that speaks has fifteen more. Weights were set by eye and by
// the lip openings they give (33 mm for jawOpen 1).
#pragma once

#include <string>
#include <vector>

#include "synth/training/blend_head.hpp"

namespace viaface {

struct Posture {
    std::string name;  // "a", "closed_relaxed", "m_pressed"
    ShapeWeights weights;
};

// /a i u e o/, mouth open, closed relaxed, closed clenched.
const std::vector<Posture>& report_postures();

// The eight of the report, then fifteen more. Their affine span holds every mix of the shapes that
// spanned_shapes() names, both sides together.
const std::vector<Posture>& talker_postures();
const std::vector<std::string>& spanned_shapes();  // sorted

const Posture& posture(const std::string& name);  // of the talker's; std::invalid_argument when unknown

}  // namespace viaface
