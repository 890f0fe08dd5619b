// The sixteen lip points of motions, as the lip model learns from them. [Basu98, section 3]
// Motion comes in any file that synth/motion/motion_input.hpp reads: measured points, which stay where they
// were measured, or a take of blend shapes, which is retargeted through a talker's own shapes.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lipmodel/lip_mesh.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {

struct LipFrames {
    Eigen::MatrixXd points;                 // [48 x frames], mm, head frame
    std::optional<MarkedPoints> rest = {};  // where the source tells it: the talker's own
    std::vector<int> incomplete = {};       // per motion: samples left out because a lip point is missing
                                            // or confidence in it
};

// Without the samples whose column "confidence", if there is one, lies below the least.
// InputError("motion", ...) when no sample is left that holds all sixteen.
LipFrames frames_of(const Motion& motion, double least_confidence = 0);

// All of the files' frames one after the other. InputError for what cannot be read, and for files of both
// kinds together: measured points and a talker's are not one person's.
LipFrames read_lip_frames(const std::vector<std::filesystem::path>& motions, const Talker& talker,
                          double least_confidence = 0);

// The talker's recitations as the codex holds them, at five samples per second.
LipFrames recited_lip_frames(const Talker& talker);

// The lips at rest: as told, else the rest_frame of the points.
MarkedPoints resting_lips(const LipFrames& frames);

}  // namespace viaface
