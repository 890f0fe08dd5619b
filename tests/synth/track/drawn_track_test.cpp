// Lips tracked in films of the built-in talkers, whose lips are known: dark and pale skin, full and thin
// lips, light from one side.
#include <gtest/gtest.h>

#include <cmath>

#include "synth/film/film_writer.hpp"
#include "synth/lips/learned_lips.hpp"
#include "synth/say/say.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "synth/track/film_track.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 360, kHeight = 288;

double apart(const Configuration& points, int a, int b) {
    return (point_of(points, a) - point_of(points, b)).head<2>().norm();
}

double correlation(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    const Eigen::ArrayXd x = a - a.mean(), y = b - b.mean();
    return (x * y).sum() / std::sqrt(x.square().sum() * y.square().sum());
}

class DrawnTrack : public testing::TestWithParam<const char*> {};

TEST_P(DrawnTrack, LiesOnTheLips) {
    TalkerShelf shelf(VIAFACE_TALKERS_FOLDER);
    SayRequest request;
    request.speech.text = "My mama bought a big map by the sea.";
    request.view.width = kWidth;
    request.view.height = kHeight;
    request.fps = {25, 1};
    const fs::path path = fs::path(testing::TempDir()) / (std::string(GetParam()) + "_drawn.mp4");
    std::vector<Configuration> drawn;
    const auto film = open_film({kWidth, kHeight, request.fps, FilmFormat::kMp4, 16000}, path);
    say(request, *shelf.load(GetParam()), *film,
        {.frame = [&](const DrawnFrame& frame) { drawn.push_back(frame.drawn); }});

    const LipModel model = learn_from(recited_lip_frames(*shelf.load("momo")), {.modes = 10}, {});
    const FilmTrack track = track_film(model, {.video = path});
    const auto frames = static_cast<Eigen::Index>(drawn.size());
    ASSERT_EQ(track.motion.size(), drawn.size());
    EXPECT_EQ(track.lost, 0);
    Eigen::ArrayXd opened(frames), seen(frames), gap(frames), seen_gap(frames);
    for (Eigen::Index i = 0; i < frames; ++i) {
        const Configuration tracked = track.motion.at(static_cast<std::size_t>(i));
        opened[i] = apart(drawn[i], kBorderTop, kBorderBottom);
        seen[i] = apart(tracked, kBorderTop, kBorderBottom);
        gap[i] = apart(drawn[i], kInnerTop, kInnerBottom);
        seen_gap[i] = apart(tracked, kInnerTop, kInnerBottom);
    }
    const auto column = [&](const char* name) {
        const auto& values = std::ranges::find(track.motion.extra, name, &ExtraColumn::name)->values;
        return Eigen::Map<const Eigen::ArrayXd>(values.data(), frames);
    };
    const double aside = 0.5 * (column("border_left_u_px") + column("border_right_u_px")).mean();
    std::printf("%s: r %.2f between borders, %.2f between inner edges (rms %.2f mm), %.1f px aside\n",
                GetParam(), correlation(opened, seen), correlation(gap, seen_gap),
                std::sqrt((gap - seen_gap).square().mean()), aside - 0.5 * (kWidth - 1));
    EXPECT_GT(correlation(opened, seen), 0.8);
    EXPECT_GT(correlation(gap, seen_gap), 0.6);
    EXPECT_LT(std::abs(aside - 0.5 * (kWidth - 1)), 4);  // px, a twelfth of the mouth
    EXPECT_LT((gap < 0.1).select(seen_gap, 1e9).minCoeff(), 0.15 * seen_gap.maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(OfAllComplexions, DrawnTrack, testing::Values("amara", "edwin"));

}  // namespace
}  // namespace viaface
