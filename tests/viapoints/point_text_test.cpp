// TRC files, CSV files of points, and the names that bring them to the layout.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/motion_trc.hpp"
#include "viapoints/point_csv.hpp"
#include "viapoints/point_names.hpp"

namespace viaface {
namespace {

template <class Read>
std::string field_of(Read read) {
    try {
        read();
    } catch (const InputError& error) {
        return error.field();
    }
    return "accepted";
}

std::string trc(const std::string& units, const std::string& frames, const std::string& rows) {
    return "PathFileType\t4\t(X/Y/Z)\tx.trc\r\n"
           "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFram"
           "es\r\n"
           "100\t100\t" +
           frames + "\t2\t" + units + "\t100\t1\t" + frames +
           "\r\n"
           "Frame#\tTime\tchin\t\t\tnose\t\t\r\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\t\r\n\r\n" +
           rows;
}

TEST(MotionTrc, ReadsUnitsGapsAndTrailingTabs) {
    const PointRecording read =
        parse_trc(trc("m", "2", "1\t0.5\t0.001\t0.002\t0.003\t\t\t\t\n2\t0.51\t0\t0\t0\t1\t2\t3\n"));
    EXPECT_EQ(read.labels, (std::vector<std::string>{"chin", "nose"}));
    EXPECT_EQ(read.time_s, (std::vector<double>{0.5, 0.51}));
    EXPECT_DOUBLE_EQ(read.positions(0, 1), 2);
    EXPECT_TRUE(read.positions.block(0, 3, 1, 3).array().isNaN().all());
    EXPECT_EQ(read.positions(1, 5), 3000);
}

TEST(MotionTrc, NamesThePlaceOfWhatIsWrong) {
    const auto of = [](const std::string& text) { return field_of([&] { parse_trc(text, "x.trc"); }); };
    const std::string row = "1\t0\t1\t2\t3\t4\t5\t6\n";
    EXPECT_EQ(of(trc("mm", "1", row)), "accepted");
    EXPECT_EQ(of(trc("inch", "1", row)), "x.trc line 3, column Units");
    EXPECT_EQ(of(trc("mm", "2", row)), "x.trc line 7, column NumFrames");
    EXPECT_EQ(of(trc("mm", "2", row + row)), "x.trc line 8, column Time");
    EXPECT_EQ(of(trc("mm", "1", "1\t0\t1\t2\t3\n")), "x.trc line 7");
    EXPECT_EQ(of(trc("mm", "1", "1\t0\t1\t2\t3\t4\tfive\t6\n")), "x.trc line 7, column nose Y");
    EXPECT_EQ(of(trc("mm", "1", "1\t0\t1\t2\t3\t4\tinf\t6\n")), "x.trc line 7, column nose Y");
    EXPECT_EQ(of(trc("mm", "0", "")), "x.trc line 3, column NumFrames");
    EXPECT_EQ(of(""), "x.trc line 0");
    EXPECT_EQ(of("PathFileType\n"), "x.trc line 1");
    std::string fewer = trc("mm", "1", row);
    fewer.erase(fewer.find("\tnose"), 5);
    EXPECT_EQ(of(fewer), "x.trc line 4, column NumMarkers");
}

TEST(MotionTrc, WritesWhatItReads) {
    PointRecording points =
        parse_trc(trc("mm", "2", "1\t0.5\t.1\t.2\t.3\t\t\t\t\n2\t0.51\t0\t0\t0\t1\t2\t3\n"));
    const PointRecording again = parse_trc(format_trc(points));
    EXPECT_EQ(again.labels, points.labels);
    EXPECT_EQ(again.time_s, points.time_s);
    EXPECT_EQ(format_trc(again), format_trc(points));
    EXPECT_TRUE(std::isnan(again.positions(0, 3)));
}

TEST(PointCsv, ReadsUnitsInNamesAndKeepsTheRest) {
    const PointRecording read =
        parse_point_csv("# by hand\nt_s,UL_x_cm,UL_z_cm,pitch,UL_y_cm\n0,1,3,440,2\n0.01,nan,,,\n");
    EXPECT_EQ(read.labels, std::vector<std::string>{"UL"});
    EXPECT_EQ(read.positions.row(0), Eigen::RowVector3d(10, 20, 30));
    EXPECT_TRUE(read.positions.row(1).array().isNaN().all());
    ASSERT_EQ(read.extra.size(), 1u);
    EXPECT_EQ(read.extra[0].name, "pitch");
    EXPECT_FALSE(read.head_frame);
    EXPECT_EQ(parse_point_csv("time_ms,A_x,A_y,A_z\n5,1,2,3\n", "x", "m").positions(0, 2), 3000);
    EXPECT_EQ(parse_point_csv("time_ms,A_x,A_y,A_z\n5,1,2,3\n", "x", "m").time_s[0], 0.005);
}

TEST(PointCsv, KnowsATalkersOwnFile) {
    const std::string text = "time_s,chin_x_mm,chin_y_mm,chin_z_mm\n0,1,2,3\n";
    EXPECT_TRUE(parse_point_csv(text).head_frame);
    EXPECT_FALSE(parse_point_csv("# " + std::string(kAnotherPerson) + "\n" + text).head_frame);
    EXPECT_FALSE(parse_point_csv("time_s,chin_x_cm,chin_y_cm,chin_z_cm\n0,1,2,3\n").head_frame);
}

TEST(PointCsv, NamesThePlaceOfWhatIsWrong) {
    const auto of = [](const std::string& text) { return field_of([&] { parse_point_csv(text, "x"); }); };
    EXPECT_EQ(of(""), "x line 0");
    EXPECT_EQ(of("frame,A_x_mm\n"), "x line 1, column 1");
    EXPECT_EQ(of("t,A_x_mm,A_y_mm\n0,1,2\n"), "x line 1, column A_x_mm");
    EXPECT_EQ(of("t,A_x,A_y,A_z\n0,1,2,3\n"), "x line 1, column A_x");
    EXPECT_EQ(of("t,a,a\n0,1,2\n"), "x line 1, column a");
    EXPECT_EQ(of("t,A_x_mm,A_y_mm,A_z_mm\n0,1,2\n"), "x line 2");
    EXPECT_EQ(of("t,A_x_mm,A_y_mm,A_z_mm\n0,1,2,2e6\n"), "x line 2, column A_z_mm");
    EXPECT_EQ(of("t,A_x_mm,A_y_mm,A_z_mm\n0,1,2,3\n0,1,2,3\n"), "x line 3, column t");
    EXPECT_EQ(of("t,A_x_mm,A_y_mm,A_z_mm\nnan,1,2,3\n"), "x line 2, column t");
}

TEST(PointNames, MapsLabelsToTheLayoutAndKeepsOthers) {
    const PointRecording read = parse_point_csv(
        "t,Momo:CHIN_x_mm,Momo:CHIN_y_mm,Momo:CHIN_z_mm,TT_x_mm,TT_y_mm,TT_z_mm,head1_x_mm,head1_y_mm,head1_"
        "z_mm\n"
        "0,1,2,3,4,5,6,7,8,9\n");
    const LaidOut out = lay_out(read);
    EXPECT_EQ(out.motion.positions(0, 3 * kChin + 1), 2);
    EXPECT_EQ(out.motion.positions(0, 3 * kTongueTip), 4);
    EXPECT_EQ(out.others, std::vector<std::string>{"head1"});
    ASSERT_EQ(out.motion.extra.size(), 3u);
    EXPECT_EQ(out.motion.extra[2].name, "head1_z_mm");
    EXPECT_EQ(parse_motion_csv(format_motion_csv(out.motion)).motion.extra.size(), 3u);
    const LaidOut mapped = lay_out(read, parse_name_map("head1=nose\n# no tongue\nTT=\n"));
    EXPECT_EQ(mapped.motion.positions(0, 3 * kNose + 2), 9);
    EXPECT_EQ(mapped.others, std::vector<std::string>{"TT"});
}

TEST(PointNames, RefusesWhatIsNotClear) {
    const PointRecording read =
        parse_point_csv("t,UL_x_mm,UL_y_mm,UL_z_mm,b_x_mm,b_y_mm,b_z_mm\n0,1,2,3,4,5,6\n");
    EXPECT_EQ(field_of([&] { lay_out(read, parse_name_map("b=border_top")); }), "motion");
    EXPECT_EQ(field_of([&] { lay_out(read, parse_name_map("c=chin")); }), "--map");
    EXPECT_EQ(field_of([&] { lay_out(read, parse_name_map("UL=\n")); }), "motion");
    EXPECT_EQ(field_of([] { parse_name_map("a=chin\n\nb=china\n"); }), "--map line 3");
    EXPECT_EQ(field_of([] { parse_name_map("a chin\n"); }), "--map line 1");
}

}  // namespace
}  // namespace viaface
