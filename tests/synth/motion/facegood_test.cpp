#include "synth/motion/facegood.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/error.hpp"

namespace viaface {
namespace {

Eigen::VectorXd curve(const BlendRecording& recording, const std::string& name) {
    const auto found = std::ranges::find(recording.names, name);
    EXPECT_NE(found, recording.names.end()) << name;
    return recording.weights.col(found - recording.names.begin());
}

TEST(Facegood, PlacesColumnsByTheTakesOwnTable) {
    RowMatrix table = RowMatrix::Zero(2, kFacegoodCurves);
    table(1, 74) = 0.5;                             // the jaw
    table.row(0).segment(42, 4) << .1, .4, .3, .2;  // four quarters of a funnel
    table(0, 63) = 0.7;                             // a curve that ARKit has no shape for
    const BlendRecording recording = facegood_recording(table);
    EXPECT_EQ(curve(recording, "jawOpen"), Eigen::Vector2d(0, 0.5));
    EXPECT_EQ(curve(recording, "mouthFunnel"), Eigen::Vector2d(0.4, 0));
    EXPECT_EQ(curve(recording, "mouth_oh_c"), Eigen::Vector2d(0.7, 0));
    EXPECT_EQ(recording.time_s, (std::vector<double>{0, 1.0 / 30}));
}

TEST(Facegood, HasEachNameOnce) {
    auto names = facegood_recording(RowMatrix::Zero(1, kFacegoodCurves)).names;
    std::ranges::sort(names);
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(Facegood, NamesThePlaceOfABadWeight) {
    RowMatrix table = RowMatrix::Zero(3, kFacegoodCurves);
    table(2, 7) = std::nan("");
    try {
        facegood_recording(table, "take.npy");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "take.npy row 2, column 7");
    }
    EXPECT_THROW(facegood_recording(RowMatrix::Zero(3, 106)), InputError);
}

// In the take that comes with the names, left and right curves of one movement go together.
TEST(Facegood, LeftAndRightOfARealTakeGoTogether) {
    const auto file =
        std::filesystem::path(VIAFACE_SOURCE_DIR) / "../shared/data/facegood/bs_value_1114_2_01.npy";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
    const BlendRecording take = read_blend_recording(file);
    for (const std::string name : {"mouthLowerDown", "mouthUpperUp", "mouthPress"}) {
        const Eigen::VectorXd l = curve(take, name + "Left"), r = curve(take, name + "Right");
        const Eigen::VectorXd a = l.array() - l.mean(), b = r.array() - r.mean();
        EXPECT_GT(a.dot(b) / (a.norm() * b.norm()), 0.9) << name;
    }
    EXPECT_NEAR(take.time_s.back(), 109.8, 0.05);
}

}  // namespace
}  // namespace viaface
