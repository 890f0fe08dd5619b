#include "synth/compare/compare_ema.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "tests/scratch_folder.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

// A second of pau, aa, b, aa, pau whose lips swing 8 mm apart and back, closest at 0.45 s.
constexpr double kClosest = 0.45;
double opening(double t) { return 12 - 8 * std::cos(2 * M_PI * (t - kClosest) / 0.4); }
double protrusion(double t) { return 2 * std::sin(7 * t); }
double jaw(double t) { return 4 * std::cos(11 * t); }

EmaRecording recording() {
    EmaRecording r;
    r.phones.sample_rate = 1000;
    const auto phone = [&](const char* name, int begin, int end) {
        r.phones.phones.push_back({parse_phone(name).phone, 0, begin, end});
    };
    phone("pau", 0, 200), phone("aa", 200, 400), phone("b", 400, 500), phone("aa", 500, 800),
        phone("pau", 800, 1000);
    for (int k = 0; k <= 100; ++k) r.time_s.push_back(k / 100.0);
    r.upper_lip = r.lower_lip = r.jaw = RowMatrix::Zero(101, 3);
    for (int k = 0; k <= 100; ++k) {
        const double t = k / 100.0;
        r.upper_lip.row(k) << protrusion(t), 0, opening(t);
        r.lower_lip.row(k) << protrusion(t), 0, 0;
        r.jaw(k, 2) = jaw(t);
    }
    return r;
}

// The same movement in the head frame, `late` s later and `scale` times as far.
Motion moved(double late, double scale) {
    Motion motion;
    for (int k = 0; k <= 250; ++k) motion.time_s.push_back(k / 250.0);
    motion.positions = RowMatrix::Zero(251, kCoordinates);
    for (int k = 0; k <= 250; ++k) {
        const double t = k / 250.0 - late;
        motion.positions(k, 3 * kBorderTop + 1) = scale * opening(t);
        motion.positions(k, 3 * kBorderTop + 2) = motion.positions(k, 3 * kBorderBottom + 2) =
            scale * protrusion(t);
        motion.positions(k, 3 * kLowerIncisor + 1) = scale * jaw(t);
    }
    return motion;
}

TEST(CompareEma, TheSameMovementAgreesWholly) {
    const EmaComparison same = compare(recording(), moved(0, 1));
    for (const Agreement& a : {same.opening, same.protrusion, same.jaw}) {
        EXPECT_NEAR(a.correlation, 1, 1e-4);
        EXPECT_NEAR(a.ratio, 1, 1e-3);
    }
    ASSERT_EQ(same.bilabials.size(), 1u);
    EXPECT_EQ(same.bilabials[0].phone, parse_phone("b").phone);
    EXPECT_NEAR(same.bilabials[0].measured_s, kClosest, 1e-9);
    EXPECT_NEAR(same.bilabials[0].moved_s, kClosest, 1e-9);
}

TEST(CompareEma, TellsSizeAndDelay) {
    const EmaComparison late = compare(recording(), moved(0.02, 1.5));
    EXPECT_NEAR(late.bilabials[0].moved_s - late.bilabials[0].measured_s, 0.02, 1e-9);
    EXPECT_LT(late.opening.correlation, 0.99);
    EXPECT_NEAR(compare(recording(), moved(0, 1.5)).jaw.ratio, 1.5, 2e-3);
    EXPECT_NEAR(compare(recording(), moved(0, -1)).jaw.correlation, -1, 1e-4);
}

TEST(CompareEma, MotionHasToCoverThePhones) {
    Motion half = moved(0, 1);
    half.time_s.resize(100);
    half.positions.conservativeResize(100, kCoordinates);
    EXPECT_THROW(compare(recording(), half), std::invalid_argument);
}

class ReadEma : public ::testing::Test {
  protected:
    fs::path write(const std::string& name, const std::string& text) {
        const fs::path file = folder_ / name;
        write_whole(file, std::string_view(text));
        return file;
    }
    const test::ScratchFolder folder_;
    std::string header_ = "t_s,UL_x_mm,UL_y_mm,UL_z_mm,LL_x_mm,LL_y_mm,LL_z_mm,JAW_x_mm,JAW_y_mm,JAW_z_mm\n";
    std::string phones_ = "# said\n0.0 0.1 sp\n0.1 0.2 AA1\n0.2 0.3 sp\n";
};

TEST_F(ReadEma, TakesColumnsByNameAndPhonesByTime) {
    const EmaRecording r = read_ema(write("m", header_ + "0.00,1,2,3,4,5,6,7,8,9\n0.01,2,2,3,4,5,6,7,8,10\n"),
                                    write("p", phones_));
    EXPECT_EQ(r.time_s, (std::vector<double>{0, 0.01}));
    EXPECT_EQ(r.lower_lip(0, 2), 6);
    EXPECT_EQ(r.jaw(1, 2), 10);
    ASSERT_EQ(r.phones.phones.size(), 3u);
    EXPECT_EQ(r.phones.phones[1].stress, 1);
    EXPECT_DOUBLE_EQ(r.phones.begin_s(1), 0.1);
}

TEST_F(ReadEma, RefusesWhatIsNoRecording) {
    const fs::path good = write("m", header_ + "0,1,2,3,4,5,6,7,8,9\n"), phones = write("p", phones_);
    EXPECT_THROW(read_ema("/no such file", phones), InputError);
    EXPECT_THROW(read_ema(write("a", ""), phones), InputError);
    EXPECT_THROW(read_ema(write("b", "t_s,UL_x_mm\n0,1\n"), phones), InputError);
    EXPECT_THROW(read_ema(write("c", header_ + "0,1,2,3,4,5,6,7,8\n"), phones), InputError);
    EXPECT_THROW(read_ema(write("d", header_ + "0,1,2,3,x,5,6,7,8,9\n"), phones), InputError);
    EXPECT_THROW(read_ema(write("e", header_ + "0,1,2,3,nan,5,6,7,8,9\n"), phones), InputError);
    EXPECT_THROW(read_ema(good, write("f", "0.0 0.1\n")), InputError);
    EXPECT_THROW(read_ema(good, write("g", "0.0 0.1 QQ\n")), InputError);
    EXPECT_THROW(read_ema(good, write("h", "0.0 0.1 AA\n0.2 0.3 B\n")), InputError);
    EXPECT_THROW(read_ema(good, write("i", "0.2 0.1 AA\n")), InputError);
    EXPECT_THROW(read_ema(good, write("j", "0.0 1e300 AA\n")), InputError);
}

}  // namespace
}  // namespace viaface
