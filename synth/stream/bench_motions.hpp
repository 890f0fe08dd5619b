// The motions that `viaface bench via` measures on: recordings where they are, and the talker's own speech.
#pragma once

#include <filesystem>

#include "synth/talker/talker.hpp"

namespace viaface {

struct BenchMotion {
    std::string name;
    Motion motion;
};

struct BenchMotions {
    std::vector<BenchMotion> phrase_takes;  // two takes of one talker, or none
    std::vector<BenchMotion> others;        // each measured with its own basis in the stream, or the talker's
    std::vector<std::string> skipped;       // what is not there, and why
};

// `data` holds facegood/ and livelink_rom/, which are moved to the talker's points by its named shapes, at
// full scale, and haskins_f01/, whose points are scaled to the talker.
BenchMotions bench_motions(const Talker& talker, const std::filesystem::path& data);

// The share of samples at which some point moves faster than 10 mm/s.
double active_share(const Motion& motion);

// The largest and the mean over points of the diagonal of the box that a point moves in, mm.
struct MotionRange {
    double largest_mm = 0, mean_mm = 0;
};
MotionRange range_of(const Motion& motion);

// The face with each of the talker's named shapes in turn, whole: [shapes x 114], mm. A stream's basis that
// holds these holds whatever is performed with them.
RowMatrix shape_positions(const Talker& talker);

// The talker's own motion for sentences, 100 per second.
Motion spoken_motion(const Talker& talker, const std::vector<std::string>& sentences);

}  // namespace viaface
