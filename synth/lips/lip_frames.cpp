#include "synth/lips/lip_frames.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "lipmodel/lip_body.hpp"
#include "synth/motion/live_link.hpp"
#include "synth/motion/motion_input.hpp"
#include "synth/motion/npy.hpp"
#include "viapoints/codex_speak.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

static_assert(kLipPoints == LipMesh::kMarked);
constexpr double kRecitedRate = 5;  // Hz: for covariances, not for motion

MarkedPoints lip_points(const Configuration& configuration) {
    return configuration.segment<LipMesh::kMarkedCoordinates>(3 * kFirstLipPoint);
}

bool is_blend_recording(const std::filesystem::path& path) {
    const Bytes bytes = read_bytes(path, "motion", kLargestNpy);
    return is_npy(bytes) || is_live_link({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// Frames without a face are left out, however many; points stay where they were measured, gaps too.
MotionInputOptions performed() { return {.longest_gap_s = std::numeric_limits<double>::infinity()}; }
MotionInputOptions measured() {
    return {.longest_gap_s = 0, .long_gaps = LongGaps::kLeave, .whose = Whose::kTalkers};
}

LipFrames joined(const std::vector<LipFrames>& parts) {
    Eigen::Index frames = 0;
    for (const LipFrames& part : parts) frames += part.points.cols();
    LipFrames whole{Eigen::MatrixXd(LipMesh::kMarkedCoordinates, frames)};
    frames = 0;
    for (const LipFrames& part : parts) {
        whole.points.middleCols(frames, part.points.cols()) = part.points;
        frames += part.points.cols();
        whole.incomplete.insert(whole.incomplete.end(), part.incomplete.begin(), part.incomplete.end());
    }
    return whole;
}

}  // namespace

LipFrames frames_of(const Motion& motion, double least_confidence) {
    const auto confidence = std::ranges::find(motion.extra, "confidence", &ExtraColumn::name);
    const auto doubted = [&](std::size_t i) {
        return confidence != motion.extra.end() && !(confidence->values[i] >= least_confidence);
    };
    std::vector<std::size_t> complete;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        if (lip_points(motion.at(i)).allFinite() && !doubted(i)) complete.push_back(i);
    }
    if (complete.empty())
        throw InputError("motion", "no sample with all lip points that is sure enough",
                         "the 16 points border_* and inner_*");
    LipFrames frames;
    frames.points.resize(LipMesh::kMarkedCoordinates, static_cast<Eigen::Index>(complete.size()));
    for (std::size_t i = 0; i < complete.size(); ++i)
        frames.points.col(static_cast<Eigen::Index>(i)) = lip_points(motion.at(complete[i]));
    frames.incomplete = {static_cast<int>(motion.size() - complete.size())};
    return frames;
}

LipFrames read_lip_frames(const std::vector<std::filesystem::path>& motions, const Talker& talker,
                          double least_confidence) {
    std::vector<LipFrames> parts;
    std::size_t blends = 0;
    for (const auto& path : motions) {
        const bool blend = is_blend_recording(path);
        blends += blend ? 1 : 0;
        parts.push_back(
            frames_of(read_motion(path, talker, blend ? performed() : measured()).motion, least_confidence));
    }
    if (blends > 0 && blends < motions.size())
        throw InputError("motion", "measured points and blend shapes", "files of one kind");
    LipFrames frames = joined(parts);
    if (blends > 0) frames.rest = lip_points(talker.poser.drawn_points(talker.face.rest));
    return frames;
}

LipFrames recited_lip_frames(const Talker& talker) {
    std::vector<LipFrames> parts;
    for (const Recitation& recitation : talker.codex.recitations) {
        ViaPointTrack track = track_of(recitation);
        if (track.time_s.size() < 2) continue;
        const MinimumJerkSpline spline(std::move(track));
        Motion motion;
        for (int n = 0; n / kRecitedRate <= duration_of(recitation); ++n)
            motion.time_s.push_back(n / kRecitedRate);
        motion.positions = to_points(talker.codex.basis, spline.at(motion.time_s));
        parts.push_back(frames_of(motion));
    }
    LipFrames frames = joined(parts);
    frames.rest = lip_points(talker.poser.drawn_points(talker.face.rest));
    return frames;
}

MarkedPoints resting_lips(const LipFrames& frames) {
    return frames.rest ? *frames.rest : MarkedPoints(frames.points.col(rest_frame(frames.points)));
}

}  // namespace viaface
