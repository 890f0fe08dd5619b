#include "viapoints/motion_c3d.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "tests/viapoints/c3d_file.hpp"

namespace viaface {
namespace {

std::string refusal(const Bytes& bytes) {
    try {
        parse_c3d(bytes, "x.c3d");
    } catch (const InputError& error) {
        return error.value();
    }
    return "read";
}

struct Kind {
    int processor;
    bool floats;
};

class C3dKinds : public testing::TestWithParam<Kind> {};

TEST_P(C3dKinds, ReadsPointsResidualsAndRateOfEveryProcessor) {
    HandC3d file;
    file.processor = GetParam().processor;
    file.floats = GetParam().floats;
    file.analog_channels = 3;
    file.analog_per_frame = 4;
    const PointRecording read = parse_c3d(file.bytes());
    EXPECT_EQ(read.labels, (std::vector<std::string>{"A", "B"}));
    ASSERT_EQ(read.size(), 3u);
    EXPECT_DOUBLE_EQ(read.time_s[2], 0.02);
    for (int f = 0; f < 3; ++f) {
        for (int p = 0; p < 2; ++p) {
            EXPECT_EQ(read.positions(f, 3 * p), f + 1.0);
            EXPECT_EQ(read.positions(f, 3 * p + 1), -(p + 1.0));
            EXPECT_EQ(read.positions(f, 3 * p + 2), 0.5);
            EXPECT_EQ(read.residuals(f, p), 4 * 0.5);
        }
    }
    EXPECT_TRUE(read.remarks.empty());
    EXPECT_FALSE(read.head_frame);
}

TEST_P(C3dKinds, MissingPointsStayMissing) {
    HandC3d file;
    file.processor = GetParam().processor;
    file.floats = GetParam().floats;
    file.at = [](int frame, int point) {
        return frame == 1 && point == 0 ? HandC3d::Raw{0, 0, 0, -1} : HandC3d::Raw{1, 2, 3, 0};
    };
    const PointRecording read = parse_c3d(file.bytes());
    EXPECT_TRUE(read.positions.block(1, 0, 1, 3).array().isNaN().all());
    EXPECT_TRUE(std::isnan(read.residuals(1, 0)));
    EXPECT_EQ(read.residuals(0, 0), 0);
    EXPECT_EQ((read.positions.array().isNaN().count()), 3);
}

INSTANTIATE_TEST_SUITE_P(Processors, C3dKinds,
                         testing::Values(Kind{84, false}, Kind{84, true}, Kind{85, false}, Kind{85, true},
                                         Kind{86, false}, Kind{86, true}));

TEST(MotionC3d, FollowsThePointersOfTheHeader) {
    HandC3d file;
    file.parameter_block = 5;
    file.spare_blocks = 3;
    file.groups_last = true;
    EXPECT_EQ(parse_c3d(file.bytes()).positions(2, 0), 3);
    file.header_data_start = 0;
    const PointRecording read = parse_c3d(file.bytes());
    EXPECT_EQ(read.positions(2, 0), 3);
    EXPECT_EQ(read.remarks.size(), 1u);
}

TEST(MotionC3d, ConvertsUnitsOrRefusesThem) {
    HandC3d file;
    file.units = "cm";
    EXPECT_EQ(parse_c3d(file.bytes()).positions(0, 0), 10);
    EXPECT_EQ(parse_c3d(file.bytes()).residuals(0, 0), 20);
    file.units = "m";
    EXPECT_EQ(parse_c3d(file.bytes()).positions(0, 0), 1000);
    file.units = "furlong";
    EXPECT_EQ(refusal(file.bytes()), "POINT:UNITS \"furlong\"");
    file.units = "";
    EXPECT_NE(refusal(file.bytes()), "read");
    EXPECT_EQ(parse_c3d(file.bytes(), "x", "cm").positions(0, 0), 10);
}

TEST(MotionC3d, CountsFramesThatOverrunAWord) {
    HandC3d file;
    file.points = 1;
    file.labels = {"A"};
    file.frames = 70000;
    file.at = [](int frame, int) { return HandC3d::Raw{frame % 1000 + 1.0, 0.5, 0, 0}; };
    file.frames_word = 65535;
    EXPECT_EQ(parse_c3d(file.bytes()).size(), 65535u);
    file.trial = {233, 0, (70000 + 232) & 0xffff, (70000 + 232) >> 16};
    const PointRecording read = parse_c3d(file.bytes());
    ASSERT_EQ(read.size(), 70000u);
    EXPECT_EQ(read.positions(69999, 0), 1000);
    file.frames_word = 70000 - 65536;
    EXPECT_EQ(parse_c3d(file.bytes()).size(), 70000u);
    file.trial = {};
    file.frames_parameter = {70000};
    EXPECT_EQ(parse_c3d(file.bytes()).size(), 70000u);
    file.frames_parameter = {};
    file.frames = file.frames_word = 40000;  // above what a signed word holds
    EXPECT_EQ(parse_c3d(file.bytes()).size(), 40000u);
}

TEST(MotionC3d, ReadsMoreThan255Labels) {
    HandC3d file;
    file.points = 300;
    file.labels.clear();
    for (int p = 0; p < 298; ++p) file.labels.push_back("P" + std::to_string(p));
    const PointRecording read = parse_c3d(file.bytes());
    EXPECT_EQ(read.labels[255], "P255");
    EXPECT_EQ(read.labels[299], "point 300");
    EXPECT_EQ(read.positions(0, 3 * 299 + 1), -300);
}

TEST(MotionC3d, LabelsAreKeptApart) {
    HandC3d file;
    file.points = 3;
    file.labels = {"A", "A", ""};
    EXPECT_EQ(parse_c3d(file.bytes()).labels, (std::vector<std::string>{"A", "A (2)", "point 3"}));
}

TEST(MotionC3d, RemarksOnUnmarkedZeros) {
    HandC3d file;
    file.at = [](int, int) { return HandC3d::Raw{0, 0, 0, 0}; };
    EXPECT_EQ(parse_c3d(file.bytes()).remarks.size(), 1u);
}

TEST(MotionC3d, RefusesContradictionsAndCounts) {
    HandC3d file;
    file.header_points = 5;
    EXPECT_EQ(refusal(file.bytes()), "POINT:USED 2.000000");
    file = {};
    file.frames_word = 60000;
    EXPECT_EQ(refusal(file.bytes()), "an end within frame 4 of 60000");
    file = {};
    file.processor = 83;
    EXPECT_NE(refusal(file.bytes()), "read");
    file = {};
    file.rate = 0;
    EXPECT_EQ(refusal(file.bytes()), "POINT:RATE 0.000000");
    file = {};
    file.floats = true;
    file.at = [](int, int) { return HandC3d::Raw{1e30, 0, 0, 0}; };
    EXPECT_EQ(refusal(file.bytes()), "frame 1, A far away");
}

TEST(MotionC3d, RefusesEveryCut) {
    const Bytes whole = HandC3d{}.bytes();
    const std::size_t data = 1024 + 3 * 2 * 8;
    ASSERT_EQ(whole.size(), data);
    for (std::size_t size = 0; size < data; ++size)
        EXPECT_NE(refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), "read")
            << size;
}

TEST(MotionC3d, AnyFlippedBitIsReadOrRefused) {
    Bytes bytes = HandC3d{}.bytes();
    std::size_t read = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
        read += refusal(bytes) == "read" ? 1 : 0;
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    }
    EXPECT_GT(read, 0u);
    EXPECT_LT(read, 8 * bytes.size());
}

PointRecording some_points(int labels, int samples) {
    PointRecording points;
    for (int p = 0; p < labels; ++p) points.labels.push_back("P" + std::to_string(p));
    points.positions.resize(samples, 3 * labels);
    points.residuals = RowMatrix::Zero(samples, labels);
    for (int i = 0; i < samples; ++i) {
        points.time_s.push_back(i / 120.0);
        for (int k = 0; k < 3 * labels; ++k) points.positions(i, k) = 100 * std::sin(i + k);
    }
    return points;
}

TEST(MotionC3d, WritesWhatItReads) {
    PointRecording points = some_points(300, 5);
    points.positions.block(3, 6, 1, 3).setConstant(std::nan(""));
    points.residuals(1, 1) = 0.25;
    points.head_frame = true;
    const PointRecording read = parse_c3d(format_c3d(points));
    EXPECT_EQ(read.labels, points.labels);
    EXPECT_TRUE(read.head_frame);
    EXPECT_EQ(read.y_screen, "+Y");
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(read.time_s[static_cast<std::size_t>(i)], i / 120.0, 1e-6);
        for (int k = 0; k < 900; ++k) {
            if (i == 3 && k / 3 == 2) {
                EXPECT_TRUE(std::isnan(read.positions(i, k)));
            } else {
                EXPECT_EQ(read.positions(i, k), static_cast<float>(points.positions(i, k)));
            }
        }
    }
    EXPECT_NEAR(read.residuals(1, 1), 0.25, 0.01);
}

TEST(MotionC3d, WritesMoreFramesThanAWordCounts) {
    EXPECT_EQ(parse_c3d(format_c3d(some_points(1, 66000))).size(), 66000u);
}

TEST(MotionC3d, RefusesToWriteUnevenTimes) {
    PointRecording points = some_points(1, 3);
    points.time_s[1] += 0.002;
    EXPECT_THROW(format_c3d(points), InputError);
}

}  // namespace
}  // namespace viaface
