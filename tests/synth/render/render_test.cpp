#include "synth/render/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "tests/synth/render/reel.hpp"
#include "tests/synth/render/spoken_motion.hpp"

namespace viaface {
namespace {

RenderRequest small() {
    RenderRequest request;
    request.view.width = request.view.height = 64;
    request.fps = {25, 1};
    return request;
}

std::vector<DrawnFrame> drawn(const RenderRequest& request, const MotionInput& moving,
                              const Sound& sound = {}) {
    std::vector<DrawnFrame> frames;
    Reel reel;
    render(request, moving, sound, momo(), reel, [&](const DrawnFrame& frame) { frames.push_back(frame); });
    return frames;
}

MotionInput opening(double rate, double seconds) {
    return {.motion = opening_motion(rate, seconds), .head = {}, .report = {}};
}

double chin(const Configuration& c) { return point_of(c, kChin).y(); }

TEST(Render, DrawsPositionsOfAnyRateAtAnyRate) {
    for (const double rate : {24.0, 30.0, 100.0, 240.0}) {
        const auto frames = drawn(small(), opening(rate, 1));
        ASSERT_EQ(frames.size(), 25u) << rate;
        for (const DrawnFrame& frame : frames) {
            const double asked = chin(momo_at_rest()) - 5 * (1 - std::cos(4 * M_PI * frame.time_s));
            EXPECT_NEAR(chin(frame.commanded), asked, 0.15) << rate << " at " << frame.time_s;
            EXPECT_NEAR(chin(frame.drawn), asked, 1) << rate << " at " << frame.time_s;
        }
    }
}

TEST(Render, SoundAndPictureBeginAndEndTogether) {
    for (const double seconds : {0.3, 1.0, 1.37}) {
        Sound sound{16000, std::vector<std::int16_t>(static_cast<std::size_t>(16000 * seconds), 7)};
        Reel reel;
        const RenderReport report = render(small(), opening(100, 0.7), sound, momo(), reel);
        EXPECT_TRUE(reel.finished);
        EXPECT_EQ(reel.sound.size(), sound.samples.size());
        EXPECT_EQ(static_cast<std::size_t>(report.frames), reel.frames.size());
        const double ends = std::max(0.7, seconds), shown = static_cast<double>(report.frames) / 25;
        EXPECT_GE(shown, ends - 1e-9);
        EXPECT_LT(shown, ends + 1.0 / 25);
        // ahead of the frames that it belongs to, as a stream needs it
        for (std::size_t n = 0; n < reel.frames.size(); ++n)
            EXPECT_GE(reel.sound_before_frame[n],
                      std::min(sound.samples.size(),
                               static_cast<std::size_t>(16000 * (0.04 * static_cast<double>(n) + 0.1))));
    }
}

TEST(Render, TakesAPartOfMotionAndSoundOnOneClock) {
    Sound sound{16000, {}};
    for (int k = 0; k < 32000; ++k) sound.samples.push_back(static_cast<std::int16_t>(k));
    RenderRequest request = small();
    request.from_s = 0.4;
    request.to_s = 0.8;
    Reel reel;
    std::vector<DrawnFrame> frames;
    render(request, opening(100, 1), sound, momo(), reel, [&](const DrawnFrame& f) { frames.push_back(f); });
    EXPECT_EQ(frames.size(), 10u);
    EXPECT_EQ(frames[0].commanded, opening(100, 1).motion.at(40));
    EXPECT_EQ(reel.sound.size(), 6400u);
    EXPECT_EQ(reel.sound.front(), 6400);
}

TEST(Render, EstimatesPointsThatAreMissing) {
    MotionInput few = opening(50, 0.5);
    for (int p = 0; p < kPoints; ++p) {
        if (p != kBorderTop && p != kBorderBottom && p != kLowerIncisor && p != kLipCornerLeft)
            few.motion.positions.middleCols<3>(3 * p).setConstant(std::nan(""));
    }
    const auto frames = drawn(small(), few), whole = drawn(small(), opening(50, 0.5));
    double lowest = 0;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        EXPECT_TRUE(frames[n].drawn.allFinite());
        EXPECT_NEAR(chin(frames[n].drawn), chin(whole[n].drawn), 3) << n;
        lowest = std::min(lowest, chin(frames[n].drawn) - chin(momo_at_rest()));
    }
    EXPECT_LT(lowest, -5);
}

TEST(Render, RecordedBlinksShutTheLids) {
    MotionInput moving = opening(25, 0.2);
    const std::size_t samples = moving.motion.size();
    Reel open, shut;
    for (const char* name : {"eyeBlink_L", "eyeBlink_R"})
        moving.motion.extra.push_back({name, std::vector<double>(samples, 0)});
    render(small(), moving, {}, momo(), open);
    for (ExtraColumn& column : moving.motion.extra) column.values.assign(samples, 1);
    render(small(), moving, {}, momo(), shut);
    EXPECT_NE(open.frames[0], shut.frames[0]);
}

TEST(Render, KeepsTheHeadsTurnsOnlyWhenAsked) {
    MotionInput moving = opening(25, 0.12);
    const Eigen::Isometry3d turned(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
    moving.head = {Eigen::Isometry3d::Identity(), turned, turned, turned};
    RenderRequest request = small();
    Reel still, turning;
    std::vector<DrawnFrame> frames;
    render(request, moving, {}, momo(), still);
    request.keep_head = true;
    render(request, moving, {}, momo(), turning, [&](const DrawnFrame& f) { frames.push_back(f); });
    EXPECT_EQ(still.frames[0], turning.frames[0]);
    EXPECT_NE(still.frames[2], turning.frames[2]);
    EXPECT_NEAR(point_of(frames[2].drawn, kNose).x(), 0, 0.5);  // points stay in the head frame
}

TEST(Render, RefusesSpansWithoutMotion) {
    const MotionInput moving = opening(25, 1);
    Reel reel;
    RenderRequest request = small();
    request.from_s = 3;
    EXPECT_THROW(render(request, moving, {}, momo(), reel), InputError);
    request.from_s = 0.5;
    request.to_s = 0.2;
    EXPECT_THROW(render(request, moving, {}, momo(), reel), InputError);
    request.from_s = std::nan("");
    EXPECT_THROW(render(request, moving, {}, momo(), reel), InputError);
    MotionInput empty = moving;
    empty.motion.positions.row(10).setConstant(std::nan(""));
    EXPECT_THROW(render(small(), empty, {}, momo(), reel), InputError);
}

}  // namespace
}  // namespace viaface
