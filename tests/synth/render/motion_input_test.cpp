#include "synth/motion/motion_input.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/synth/render/spoken_motion.hpp"
#include "viapoints/motion_at.hpp"
#include "viapoints/motion_c3d.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/motion_trc.hpp"
#include "viapoints/point_names.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

class MotionFile : public testing::Test {
  protected:
    template <class Content>
    fs::path file(const std::string& name, const Content& content) const {
        write_whole(folder_ / name, content);
        return folder_ / name;
    }
    const test::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

double apart(const Motion& a, const Motion& b) { return (a.positions - b.positions).cwiseAbs().maxCoeff(); }

bool says(const MotionInput& input, const std::string& part) {
    for (const std::string& line : input.report) {
        if (line.find(part) != line.npos) return true;
    }
    return false;
}

// A person larger than the talker in axes of his own, who nods, with four markers on his skull.
PointRecording person() {
    const Motion motion = opening_motion(100, 2, 0.6);
    PointRecording r = labelled(motion);
    const auto points = static_cast<Eigen::Index>(r.labels.size());
    const Eigen::RowVector3d skull[] = {{0, 110, 20}, {60, 95, -10}, {-60, 96, -12}, {0, 130, -30}};
    r.positions.conservativeResize(Eigen::NoChange, 3 * (points + 4));
    for (Eigen::Index k = 0; k < 4; ++k) {
        r.labels.push_back("skull" + std::to_string(k));
        r.positions.middleCols<3>(3 * (points + k)).rowwise() = skull[k];
    }
    Eigen::Matrix3d file_from_head;
    file_from_head << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    for (Eigen::Index i = 0; i < r.positions.rows(); ++i) {
        const Eigen::AngleAxisd nod(0.2 * std::sin(3 * r.time_s[static_cast<std::size_t>(i)]),
                                    Eigen::Vector3d::UnitX());
        for (Eigen::Index p = 0; p < points + 4; ++p) {
            const Eigen::Vector3d place = nod * (1.2 * r.positions.block<1, 3>(i, 3 * p).transpose());
            r.positions.block<1, 3>(i, 3 * p) =
                (file_from_head * place + Eigen::Vector3d(500, 40, 900)).transpose();
        }
    }
    return r;
}

TEST_F(MotionFile, ATalkersOwnPointsComeAsTheyAre) {
    const Motion motion = opening_motion(100, 1);
    EXPECT_EQ(apart(read_motion(file("a.csv", format_motion_csv(motion)), momo()).motion, motion), 0);
    PointRecording points = labelled(motion);
    points.head_frame = true;
    EXPECT_LT(apart(read_motion(file("a.c3d", format_c3d(points)), momo()).motion, motion), 1e-4);
    MotionInputOptions his;
    his.whose = Whose::kTalkers;
    EXPECT_EQ(apart(read_motion(file("a.trc", format_trc(points)), momo(), his).motion, motion), 0);
}

// What another person did, in every format: without his head's motion, in the talker's size, axes and place.
TEST_F(MotionFile, AnotherPersonsPointsBecomeTheTalkers) {
    const Motion wanted = opening_motion(100, 2, 0.6);
    for (const fs::path& path : {file("p.c3d", format_c3d(person())), file("p.trc", format_trc(person()))}) {
        for (const std::vector<std::string>& markers :
             {std::vector<std::string>{"skull0", "skull1", "skull2", "skull3"},
              std::vector<std::string>{"found"}}) {
            MotionInputOptions options;
            options.head_markers = markers;
            const MotionInput read = read_motion(path, momo(), options);
            EXPECT_LT(apart(read.motion, wanted), 0.01) << path;
            EXPECT_TRUE(says(read, "scale: 0.833, 0.833, 0.833"));
            EXPECT_TRUE(says(read, "point forward,left,up"));
            EXPECT_EQ(read.head.size(), wanted.size());
            EXPECT_NEAR(Eigen::AngleAxisd(read.head[52].linear()).angle(), 0.2 * std::sin(3 * 0.52), 0.002);
        }
    }
}

TEST_F(MotionFile, GapsAreBridgedReportedOrRefused) {
    PointRecording r = person();
    r.positions.block(120, 3 * 8, 10, 3).setConstant(std::nan(""));
    MotionInputOptions options;
    options.head_markers = {"skull0", "skull1", "skull2", "skull3"};
    const fs::path path = file("p.c3d", format_c3d(r));
    const MotionInput read = read_motion(path, momo(), options);
    EXPECT_TRUE(says(read, "gap: chin, 0.110 s from 1.190 s, bridged"));
    EXPECT_LT(apart(read.motion, opening_motion(100, 2, 0.6)), 1);
    options.longest_gap_s = 0.05;
    EXPECT_THROW(read_motion(path, momo(), options), InputError);
    options.long_gaps = LongGaps::kLeave;
    EXPECT_TRUE(std::isnan(read_motion(path, momo(), options).motion.positions(125, 3 * kChin)));
}

TEST_F(MotionFile, AFacelessSpanOfATakeIsBridgedOrRefused) {
    std::string take = "Timecode,BlendShapeCount,JawOpen,EyeBlinkLeft\n";
    for (int n = 0; n < 60; ++n) {
        const std::string code = "10:00:00:" + std::to_string(n) + ".0,";
        take += n >= 20 && n < 25 ? code + "0\n" : code + "2," + (n % 2 == 0 ? "0.25" : "0.5") + ",0\n";
    }
    const MotionInput read = read_motion(file("t.csv", take), momo());
    EXPECT_EQ(read.motion.size(), 55u);
    EXPECT_TRUE(says(read, "gap: no face for 0.100 s from 0.317 s, bridged"));
    MotionInputOptions options;
    options.longest_gap_s = 0.05;
    EXPECT_THROW(read_motion(file("t.csv", take), momo(), options), InputError);
}

TEST_F(MotionFile, AStreamComesWithinItsBound) {
    const Motion motion = opening_motion(50, 2);
    const EncodedStream encoded = encode_stream(motion, nullptr, {.max_error_mm = 0.5});
    const MotionInput read = read_motion(file("a.via", encoded.bytes), momo());
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const Configuration off = motion_at(read.motion, motion.time_s[i]) - motion.at(i);
        for (int p = 0; p < kPoints; ++p) EXPECT_LT(point_of(off, p).norm(), 0.51) << i;
    }
    Bytes cut = encoded.bytes;
    cut.resize(20);
    EXPECT_THROW(read_motion(file("cut.via", cut), momo()), InputError);
}

TEST_F(MotionFile, WhatIsNoMotionIsRefusedByName) {
    for (const std::string& text :
         {std::string(), std::string("hello"), std::string(600, '\0'), std::string("\x02P")}) {
        try {
            read_motion(file("x.bin", text), momo());
            FAIL();
        } catch (const InputError& error) {
            EXPECT_EQ(error.field().rfind("x.bin", 0), 0u) << error.field();
        }
    }
    EXPECT_THROW(read_motion(folder_ / "none.csv", momo()), InputError);
}

// The whole of a real sentence of articulography: 7 points, other axes.
TEST_F(MotionFile, ReadsARealRecordingOfArticulography) {
    const fs::path real = fs::path(VIAFACE_SOURCE_DIR) / "../shared/data/haskins_f01/F01_B01_S01_R01_N.csv";
    if (!fs::exists(real)) GTEST_SKIP() << "no " << real;
    const MotionInput read = read_motion(real, momo());
    EXPECT_TRUE(says(read, "point forward,left,up"));
    const auto& p = read.motion.positions;
    const Eigen::VectorXd lips = p.col(3 * kBorderTop + 1) - p.col(3 * kBorderBottom + 1);
    EXPECT_GT(lips.maxCoeff() - lips.minCoeff(), 8);
    EXPECT_LT(lips.maxCoeff() - lips.minCoeff(), 25);
}

}  // namespace
}  // namespace viaface
