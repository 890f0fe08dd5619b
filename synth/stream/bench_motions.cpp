#include "synth/stream/bench_motions.hpp"

#include <algorithm>
#include <cmath>

#include "synth/motion/motion_input.hpp"
#include "synth/motion/retarget.hpp"
#include "synth/say/recital.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;

constexpr double kMoving = 10;       // mm/s
constexpr double kSpokenRate = 100;  // Hz

BenchMotion performed(const Talker& talker, const std::string& name, const fs::path& file) {
    Motion motion = retarget(talker.face, talker.poser, read_blend_recording(file)).motion;
    motion.extra.clear();
    return {name, std::move(motion)};
}

void add_performed(BenchMotions& motions, const Talker& talker, const fs::path& data) {
    if (talker.face.shapes.empty()) {
        motions.skipped.push_back("phrase takes and livelink_rom: the talker has no named shapes to move");
        return;
    }
    const fs::path first = data / "facegood" / "bs_value_1114_2_01.npy",
                   second = data / "facegood" / "bs_value_1114_2_03.npy";
    if (fs::exists(first) && fs::exists(second)) {
        motions.phrase_takes = {performed(talker, "phrases 1", first),
                                performed(talker, "phrases 2", second)};
    } else {
        motions.skipped.push_back("phrase takes: " + first.string() + " is not there");
    }
    const fs::path rom = data / "livelink_rom" / "alex_rom_3.csv";
    if (fs::exists(rom)) {
        motions.others.push_back(performed(talker, "range of motion", rom));
    } else {
        motions.skipped.push_back("range of motion: " + rom.string() + " is not there");
    }
}

void add_measured(BenchMotions& motions, const Talker& talker, const fs::path& file) {
    if (!fs::exists(file)) {
        motions.skipped.push_back("measured sentence: " + file.string() + " is not there");
        return;
    }
    Motion motion = read_motion(file, talker).motion;
    motion.extra.clear();
    motions.others.push_back({"measured lips", std::move(motion)});
}

}  // namespace

Motion spoken_motion(const Talker& talker, const std::vector<std::string>& sentences) {
    Motion motion;
    std::vector<RowMatrix> parts;
    Index rows = 0;
    for (const std::string& sentence : sentences) {
        SpeechRequest request;
        request.text = sentence;
        const Recital recital = recite(talker.codex, Script(request).utterance(0));
        std::vector<double> times;
        for (std::int64_t n = 0; static_cast<double>(n) / kSpokenRate < recital.track.time_s.back(); ++n) {
            times.push_back(static_cast<double>(n) / kSpokenRate);
            motion.time_s.push_back(static_cast<double>(motion.time_s.size()) / kSpokenRate);
        }
        parts.push_back(recital.motion.at(times));
        rows += parts.back().rows();
    }
    motion.positions.resize(rows, kCoordinates);
    Index at = 0;
    for (const RowMatrix& part : parts) {
        motion.positions.middleRows(at, part.rows()) = part;
        at += part.rows();
    }
    return motion;
}

RowMatrix shape_positions(const Talker& talker) {
    const auto shapes = static_cast<Index>(talker.face.shapes.size());
    if (shapes == 0) return RowMatrix(0, kCoordinates);
    BlendRecording each;
    for (const NamedShape& shape : talker.face.shapes) {
        each.time_s.push_back(static_cast<double>(each.names.size()));
        each.names.push_back(shape.name);
    }
    each.weights = RowMatrix::Identity(shapes, shapes);
    return retarget(talker.face, talker.poser, each).motion.positions;
}

BenchMotions bench_motions(const Talker& talker, const fs::path& data) {
    BenchMotions motions;
    add_performed(motions, talker, data);
    add_measured(motions, talker, data / "haskins_f01" / "F01_B01_S01_R01_N.csv");
    motions.others.push_back(
        {"own speech",
         spoken_motion(talker, {"The boy has a big red ball.", "Please call me when you leave the house.",
                                "We were away a year ago.", "Five or six people moved to the front."})});
    return motions;
}

double active_share(const Motion& motion) {
    const std::vector<int> points = measured_points(motion.positions, "motion");
    std::size_t active = 0;
    for (std::size_t i = 1; i < motion.size(); ++i) {
        const auto row = static_cast<Index>(i);
        const double moved =
            longest_triple(coordinates_of(motion.positions.row(row) - motion.positions.row(row - 1), points));
        active += moved > kMoving * (motion.time_s[i] - motion.time_s[i - 1]);
    }
    return static_cast<double>(active) / static_cast<double>(motion.size() - 1);
}

MotionRange range_of(const Motion& motion) {
    MotionRange range;
    const std::vector<int> points = measured_points(motion.positions, "motion");
    for (const int p : points) {
        const auto own = motion.positions.middleCols<3>(3 * p);
        const double diagonal = (own.colwise().maxCoeff() - own.colwise().minCoeff()).norm();
        range.largest_mm = std::max(range.largest_mm, diagonal);
        range.mean_mm += diagonal / static_cast<double>(points.size());
    }
    return range;
}

}  // namespace viaface
