#include "synth/lips/lip_frames.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "lipmodel/lip_body.hpp"
#include "synth/lips/learned_lips.hpp"
#include "tests/scratch_folder.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

const Talker& momo() {
    static const Talker talker = load_talker(fs::path(VIAFACE_TALKERS_FOLDER) / "momo");
    return talker;
}

class LipFramesOf : public testing::Test {
  protected:
    fs::path scratch(const std::string& name) const { return folder_ / name; }
    const test::ScratchFolder folder_;
};

// The talker opens and rounds the mouth by two of its shapes, as a Live Link take.
std::string take(int frames) {
    std::string text = "Timecode,BlendShapeCount,JawOpen,MouthPucker,MouthSmileLeft\n";
    for (int i = 0; i < frames; ++i) {
        const auto wave = [&](double step) { return std::to_string(0.5 + 0.5 * std::sin(step * i)); };
        text += "00:00:" + std::to_string(10 + i / 60) + ":" + std::to_string(i % 60) + ".000,3," +
                wave(0.3) + "," + wave(0.17) + "," + wave(0.071) + "\n";
    }
    return text;
}

TEST_F(LipFramesOf, ATakeRestWhereTheTalkerRests) {
    write_whole(scratch("take.csv"), take(120));
    const LipFrames frames = read_lip_frames({scratch("take.csv")}, momo());
    EXPECT_EQ(frames.points.cols(), 120);
    ASSERT_TRUE(frames.rest.has_value());
    const MarkedPoints rest = resting_lips(frames);
    EXPECT_LT(lip_opening(rest), 2);
    const LipModel model = learn_from(frames, {.modes = 10, .noise_mm = 0.01}, {"take.csv"});
    EXPECT_EQ(model.modes.cols(), 3);  // three shapes move it
    EXPECT_EQ(model.provenance, "learned from take.csv");
    EXPECT_LT((marked_of(as_column(model.rest)) - rest).norm(), 1e-6);
}

TEST_F(LipFramesOf, TrainingGoesOnFromAModel) {
    write_whole(scratch("take.csv"), take(120));
    const LipFrames frames = read_lip_frames({scratch("take.csv")}, momo());
    const LipModel first = learn_from(frames, {.modes = 10, .noise_mm = 0.01}, {"take.csv"});
    // Another way to move: the lower lip's middle alone, 5 mm of standard deviation.
    LipFrames more;
    more.points = resting_lips(frames).replicate(1, 120);
    for (int i = 0; i < 120; ++i) more.points(3 * 4 + 1, i) += 5 * std::sqrt(2) * std::sin(0.4 * i);
    const LipModel second = learn_on(first, more, {.modes = 10, .noise_mm = 0.01}, {"more.csv"});
    EXPECT_GT(second.modes.cols(), first.modes.cols());
    EXPECT_EQ(second.provenance, "learned from take.csv; then learned from more.csv");
    const auto left_by = [&](const LipModel& model) {
        double sum = 0;
        for (const auto& lips : {frames.points, more.points}) {
            for (Eigen::Index i = 0; i < lips.cols(); i += 10) {
                const LipBody body = lip_body(marked_of(as_column(model.rest)));
                const Eigen::VectorXd shape =
                    as_column(body.mesh.nodes) +
                    body.spread * (lips.col(i) - marked_of(as_column(body.mesh.nodes)));
                sum += (lip_shape(model, lip_modes_of(model, shape)) - shape).norm();
            }
        }
        return sum;
    };
    EXPECT_LT(left_by(second), 0.1 * left_by(first));
}

TEST_F(LipFramesOf, SamplesOfLittleConfidenceAreLeftOut) {
    Motion motion{{}, RowMatrix::Zero(4, kCoordinates), {{"confidence", {0.95, 0.5, std::nan(""), 0.9}}}};
    motion.time_s = {0, 0.1, 0.2, 0.3};
    EXPECT_EQ(frames_of(motion, 0.9).points.cols(), 2);
    EXPECT_EQ(frames_of(motion, 0.9).incomplete, std::vector<int>{2});
    EXPECT_EQ(frames_of(motion, 0.4).points.cols(), 3);
    EXPECT_THROW(frames_of(motion, 0.99), InputError);
}

TEST_F(LipFramesOf, MeasuredPointsLeaveOutIncompleteSamples) {
    write_whole(scratch("take.csv"), take(60));
    const LipFrames whole = read_lip_frames({scratch("take.csv")}, momo());
    Motion motion{{}, RowMatrix::Constant(whole.points.cols(), kCoordinates, NAN), {}};
    for (Eigen::Index i = 0; i < whole.points.cols(); ++i) {
        motion.time_s.push_back(0.01 * static_cast<double>(i));
        motion.positions.row(i).segment<48>(3 * kFirstLipPoint) = whole.points.col(i);
    }
    motion.positions(7, 3 * kFirstLipPoint + 1) = NAN;
    write_motion_csv(scratch("points.csv"), motion);
    const LipFrames read = read_lip_frames({scratch("points.csv")}, momo());
    EXPECT_EQ(read.points.cols(), whole.points.cols() - 1);
    EXPECT_EQ(read.incomplete, std::vector<int>{1});
    EXPECT_FALSE(read.rest.has_value());
    EXPECT_EQ(read.points.col(7), whole.points.col(8));
    EXPECT_LT(lip_opening(resting_lips(read)), 5);
    EXPECT_THROW(read_lip_frames({scratch("points.csv"), scratch("take.csv")}, momo()), InputError);
    motion.positions.col(3 * kFirstLipPoint).setConstant(NAN);
    EXPECT_THROW(frames_of(motion), InputError);
}

TEST_F(LipFramesOf, WhatDoesNotMoveAreRefused) {
    write_whole(scratch("still.csv"), std::string("Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,1,0\n"));
    EXPECT_THROW(learn_from(read_lip_frames({scratch("still.csv")}, momo()), {}, {}), InputError);
}

TEST_F(LipFramesOf, RecitationsComeFromTheCodex) {
    const LipFrames recited = recited_lip_frames(momo());
    EXPECT_GT(recited.points.cols(), 1000);
    EXPECT_TRUE(recited.points.allFinite());
}

}  // namespace
}  // namespace viaface
