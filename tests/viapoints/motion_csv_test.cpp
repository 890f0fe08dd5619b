#include "viapoints/motion_csv.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <filesystem>
#include <locale>

#include "base/error.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/viapoints/smooth_motion.hpp"

namespace viaface {
namespace {

using Eigen::Index;

const std::string kHeader = "time_s,chin_x_mm,chin_y_mm,chin_z_mm,jaw_open\n";

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(const Motion& one, const Motion& other) {
    EXPECT_EQ(one.time_s, other.time_s);
    ASSERT_EQ(one.positions.rows(), other.positions.rows());
    for (Index i = 0; i < one.positions.size(); ++i) {
        ASSERT_TRUE(same(one.positions.data()[i], other.positions.data()[i])) << i;
    }
    ASSERT_EQ(one.extra.size(), other.extra.size());
    for (std::size_t k = 0; k < one.extra.size(); ++k) {
        EXPECT_EQ(one.extra[k].name, other.extra[k].name);
        ASSERT_EQ(one.extra[k].values.size(), other.extra[k].values.size());
        for (std::size_t i = 0; i < one.size(); ++i)
            EXPECT_TRUE(same(one.extra[k].values[i], other.extra[k].values[i]));
    }
}

TEST(MotionCsv, ReadsPointsExtraColumnsCommentsAndMissingCells) {
    const MotionCsv csv = parse_motion_csv("# rate 100 Hz\n" + kHeader +
                                           "0,1.5,-2e1,.25,0.5\r\n"
                                           "\n"
                                           "#between\n"
                                           "0.01,NaN,nan,,\n"
                                           " 0.02 , 1 ,\t2, 3 ,4");
    EXPECT_EQ(csv.comments, (std::vector<std::string>{"rate 100 Hz", "between"}));
    EXPECT_EQ(csv.motion.time_s, (std::vector<double>{0, 0.01, 0.02}));
    EXPECT_EQ(point_of(csv.motion.at(0), kChin), Eigen::Vector3d(1.5, -20, 0.25));
    EXPECT_TRUE(point_of(csv.motion.at(1), kChin).array().isNaN().all());
    EXPECT_EQ(point_of(csv.motion.at(2), kChin), Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(point_of(csv.motion.at(0), kNose).array().isNaN().all()) << "missing is NaN, never 0";
    ASSERT_EQ(csv.motion.extra.size(), 1u);
    EXPECT_EQ(csv.motion.extra[0].name, "jaw_open");
    EXPECT_EQ(csv.motion.extra[0].values[0], 0.5);
    EXPECT_TRUE(std::isnan(csv.motion.extra[0].values[1]));
}

TEST(MotionCsv, ColumnsMayComeInAnyOrderOfPoints) {
    const MotionCsv csv = parse_motion_csv(
        "time_s,a,nose_x_mm,nose_y_mm,nose_z_mm,b,lip_top_x_mm,lip_top_y_mm,lip_top_z_mm\n"
        "1,10,1,2,3,20,4,5,6\n");
    EXPECT_EQ(point_of(csv.motion.at(0), kNose), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(point_of(csv.motion.at(0), kLipTop), Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(csv.motion.extra[0].values, std::vector<double>{10});
    EXPECT_EQ(csv.motion.extra[1].values, std::vector<double>{20});
}

TEST(MotionCsv, WrittenAndReadBackIsEqualBitByBit) {
    Motion motion = smooth_motion(1, 1, 97, 20);
    motion.positions(3, 4) = kCoordinates * 0.1;
    motion.positions(5, 6) = std::nan("");
    motion.positions(6, 7) = 5e-324;
    motion.positions(7, 7) = -1.0 / 3;
    motion.extra = {{"UL_x_mm", std::vector<double>(motion.size(), 1e300)},
                    {"été", std::vector<double>(motion.size(), 0.1)}};
    motion.extra[0].values[2] = std::nan("");
    const std::vector<std::string> comments{"units: mm", "", "  indented, with commas"};
    const MotionCsv back = parse_motion_csv(format_motion_csv(motion, comments));
    EXPECT_EQ(back.comments, comments);
    expect_same(back.motion, motion);
}

TEST(MotionCsv, FilesReadBackToo) {
    const test::ScratchFolder folder;
    const auto path = folder / "motion.csv";
    const Motion motion = smooth_motion(2, 1, 60, kPoints);
    write_motion_csv(path, motion);
    expect_same(read_motion_csv(path).motion, motion);
    std::filesystem::remove(path);
    EXPECT_THROW(read_motion_csv(path), InputError);
}

struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

TEST(MotionCsv, TheLocaleDoesNotMatter) {
    const std::string text = kHeader + "0.5,1.25,2,3,1234567.5\n";
    const std::string c_locale = std::setlocale(LC_ALL, nullptr);
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
    const std::string again = format_motion_csv(parse_motion_csv(text).motion);
    std::locale::global(before);
    std::setlocale(LC_ALL, c_locale.c_str());
    EXPECT_EQ(again, text);
}

struct Rubbish {
    std::string text, field, allowed;
};

TEST(MotionCsv, RubbishIsRefusedWithLineAndColumn) {
    const std::vector<Rubbish> all{
        {"", "motion line 0", "header"},
        {"# only a comment\n", "motion line 1", "header"},
        {kHeader, "motion line 1", "at least one sample"},
        {"t,chin_x_mm\n1,2\n", "motion line 1, column 1", "time_s"},
        {"time_s;a\n", "motion line 1, column 1", "time_s"},
        {"time_s,\n0,1\n", "motion line 1, column 2", "name"},
        {"time_s,a,a\n0,1,2\n", "motion line 1, column a", "once"},
        {"time_s,a,time_s\n0,1,2\n", "motion line 1, column time_s", "once"},
        {"time_s,chin_x_mm,chin_y_mm\n0,1,2\n", "motion line 1, column chin_x_mm", "side by side"},
        {"time_s,chin_x_mm,chin_z_mm,chin_y_mm\n0,1,2,3\n", "motion line 1, column chin_x_mm",
         "in this order"},
        {"time_s,chin_y_mm,chin_z_mm\n0,1,2\n", "motion line 1, column chin_y_mm", "side by side"},
        {"time_s,chin_x_cm,chin_y_cm,chin_z_cm\n0,1,2,3\n", "motion line 1, column chin_x_cm", "chin_x_mm"},
        {"time_s,chin_x,chin_y,chin_z\n0,1,2,3\n", "motion line 1, column chin_x", "chin_x_mm"},
        {kHeader + "0,1,2,3\n", "motion line 2", "header has: 5"},
        {kHeader + "0,1,2,3,4,5\n", "motion line 2", "header has: 5"},
        {kHeader + "0,1,2,3,4\n\n0,1,2,3,4\n", "motion line 4, column time_s", "above"},
        {kHeader + "nan,1,2,3,4\n", "motion line 2, column time_s", "above"},
        {kHeader + "0,1,two,3,4\n", "motion line 2, column chin_y_mm", "finite number"},
        {kHeader + "0,1,2,3,4x\n", "motion line 2, column jaw_open", "finite number"},
        {kHeader + "0,1,2,0x3,4\n", "motion line 2, column chin_z_mm", "finite number"},
        {kHeader + "0,inf,2,3,4\n", "motion line 2, column chin_x_mm", "finite number"},
        {kHeader + "0,1e999,2,3,4\n", "motion line 2, column chin_x_mm", "finite number"},
        {kHeader + "0,nan(1),2,3,4\n", "motion line 2, column chin_x_mm", "finite number"},
        {kHeader + "0,1e7,2,3,4\n", "motion line 2, column chin_x_mm", "within 1e6 mm"},
        {kHeader + std::string("0,\0,2,3,4\n", 11), "motion line 2, column chin_x_mm", "finite number"},
        {std::string("time_s,a\0b\n0,1\n", 15), "motion line 1, column 2", "control"},
        {std::string(5000, ','), "motion line 1, column 1", "time_s"},
    };
    for (const Rubbish& bad : all) {
        try {
            parse_motion_csv(bad.text);
            ADD_FAILURE() << bad.text;
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), bad.field) << bad.text;
            EXPECT_NE(error.allowed().find(bad.allowed), std::string::npos) << error.what();
        }
    }
}

TEST(MotionCsv, SizesAreBounded) {
    std::string header = "time_s";
    for (std::size_t i = 0; i < kMotionCsvColumns; ++i) header += ",c" + std::to_string(i);
    EXPECT_THROW(parse_motion_csv(header + "\n"), InputError);
    EXPECT_THROW(parse_motion_csv(std::string(kMotionCsvBytes + 1, '\n')), InputError);
}

TEST(MotionCsv, EveryTruncationIsReadOrRefused) {
    const std::string whole = format_motion_csv(smooth_motion(3, 0.1, 50, 3), {"cut"});
    std::size_t read = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
        try {
            read += !parse_motion_csv(whole.substr(0, size)).motion.time_s.empty();
        } catch (const InputError&) {
        }
    }
    EXPECT_GT(read, 0u);
    EXPECT_LT(read, whole.size() / 2);
}

TEST(MotionCsv, WhatCannotBeWrittenIsRefused) {
    const Motion motion = smooth_motion(4, 0.1, 50, 3);
    EXPECT_THROW(format_motion_csv(motion, {"two\nlines"}), std::invalid_argument);
    for (const char* name : {"", "a,b", " a", "a\n", "time_s", "chin_x_mm", "chin_x_cm"}) {
        Motion named = motion;
        named.extra = {{name, std::vector<double>(motion.size(), 0.0)}};
        EXPECT_THROW(format_motion_csv(named), std::invalid_argument) << name;
    }
    Motion short_of_times = motion;
    short_of_times.time_s.pop_back();
    EXPECT_THROW(format_motion_csv(short_of_times), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
