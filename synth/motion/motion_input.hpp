// Any motion file as motion of a talker's points, with a report of what was done to it:
//   .npy, Live Link Face CSV      -> blend shapes retargeted at full scale (retarget.hpp)
//   .via                          -> decoded and sampled at 100 Hz
//   .c3d, .trc, .csv              -> gaps bridged -> head motion removed -> names of the layout
//                                 -> another person's points as the talker's, unless they are a talker's own
// Kinds are told by their first bytes, not by their names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "synth/talker/talker.hpp"
#include "viapoints/another_person.hpp"
#include "viapoints/gaps.hpp"
#include "viapoints/head_motion.hpp"
#include "viapoints/point_recording.hpp"
#include "viapoints/stream_model.hpp"

namespace viaface {

enum class Whose { kAsTheFileSays, kTalkers, kAnothers };

struct MotionInputOptions {
    std::string unit = {};           // where the file names none
    std::filesystem::path map = {};  // labels to the layout: point_names.hpp; empty: none
    double longest_gap_s = 0.2;
    LongGaps long_gaps = LongGaps::kRefuse;
    std::vector<std::string> head_markers = {};  // empty: the head stays; "found": the least moving points
    Whose whose = Whose::kAsTheFileSays;
    PersonOptions person = {};
    std::vector<StreamModel> stream_models = {};  // that a stream may name
};

struct MotionInput {
    Motion motion;                        // mm, the talker's head frame
    std::vector<Eigen::Isometry3d> head;  // [samples]: where the head has gone, in the head frame; or none
    std::optional<Person> person = {};    // where the points are another person's
    std::vector<std::string> report;      // lines for people
};

// InputError naming the place.
MotionInput read_motion(const std::filesystem::path& file, const Talker& talker,
                        const MotionInputOptions& options = {});

// The same of a file's bytes; `field` names it in errors.
MotionInput motion_of(const Bytes& bytes, const std::string& field, const Talker& talker,
                      const MotionInputOptions& options = {});

// Points, rate, span, ranges: what a motion is, in lines.
std::vector<std::string> description_of(const Motion& motion);

}  // namespace viaface
