// The options of the commands that read a motion file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "synth/motion/motion_input.hpp"

namespace viaface {

struct MotionOptions {
    std::string file, unit, map, head_markers, axes = "found", rest, scale, whose;
    double longest_gap = 0.2;
    bool leave_gaps = false;

    // InputError naming the option. `talker` is whose face it moves.
    MotionInputOptions parsed(const std::string& talker) const;
};

void add_motion_options(CLI::App& app, MotionOptions& options);

}  // namespace viaface
