#include "synth/picture/view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "base/error.hpp"

namespace viaface {
namespace {

std::string field_of_error(const View& view) {
    try {
        check(view);
    } catch (const InputError& error) {
        return error.field();
    }
    return "";
}

TEST(View, DefaultsAreAllowed) { EXPECT_EQ(field_of_error(View{}), ""); }

TEST(View, SizesOutsideTheLimitsAreRefused) {
    for (const int bad : {-1, 0, 15, 4097, 100000}) {
        EXPECT_EQ(field_of_error({.width = bad}), "size") << bad;
        EXPECT_EQ(field_of_error({.height = bad}), "size") << bad;
    }
    EXPECT_EQ(field_of_error({.width = 16, .height = 4096}), "");
}

TEST(View, AnglesOutsideTheLimitsAreRefused) {
    for (const double bad :
         {1e9, -180.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(field_of_error({.yaw = bad}), "yaw") << bad;
        EXPECT_EQ(field_of_error({.tilt = bad}), "tilt") << bad;
        EXPECT_EQ(field_of_error({.roll = bad}), "roll") << bad;
        EXPECT_EQ(field_of_error({.field_of_view = bad}), "field_of_view") << bad;
    }
}

TEST(View, BackgroundsAreRead) {
    EXPECT_EQ(parse_background("#0a80FF"), (Rgb{10, 128, 255}));
    EXPECT_EQ(parse_background("white"), (Rgb{255, 255, 255}));
}

TEST(View, OtherBackgroundsAreRefused) {
    for (const char* bad :
         {"", "#", "#12345", "#1234567", "#12345g", "#-12345", "# 12345", "0a80ff", "mauve"}) {
        EXPECT_THROW(parse_background(bad), InputError) << bad;
    }
}

// Where a place of the head falls in the picture, in pixels from the lower left corner.
Eigen::Vector2d pixel(const View& view, const Eigen::Vector3d& place) {
    const Camera camera = camera_of(view);
    const Eigen::Vector4d clip = camera.clip_from_world * camera.world_from_head * place.homogeneous();
    return {(clip.x() / clip.w() + 1) / 2 * view.width, (clip.y() / clip.w() + 1) / 2 * view.height};
}

const Eigen::Vector3d kNoseTip(0, 39, 24);

TEST(View, TurnsGoTheWaySaid) {
    const Eigen::Vector2d straight = pixel({}, kNoseTip);
    EXPECT_NEAR(straight.x(), 256, 1e-9);
    EXPECT_GT(pixel({.yaw = 20}, kNoseTip).x(), straight.x() + 50);
    EXPECT_GT(pixel({.tilt = 20}, kNoseTip).y(), straight.y() + 50);
    EXPECT_GT(pixel({.roll = 20}, {60, 35, -106}).y(), pixel({}, {60, 35, -106}).y() + 20);
}

TEST(View, OtherShapesOfPictureShowTheHeadAtItsSize) {
    const double span = pixel({}, {70, 35, -106}).x() - pixel({}, {-70, 35, -106}).x();
    for (const View& view : {View{.width = 1024}, View{.height = 1024}}) {
        EXPECT_NEAR(pixel(view, {70, 35, -106}).x() - pixel(view, {-70, 35, -106}).x(), span, 0.01 * span);
    }
    const Eigen::Vector3d collar(0, -95, -106);
    EXPECT_NEAR(pixel({.height = 1024}, collar).y(), pixel({}, collar).y(), 4);
}

TEST(View, AWiderFieldComesNearerAndKeepsTheSize) {
    const Eigen::Vector3d ear(80, 41, -106);
    EXPECT_NEAR(pixel({.field_of_view = 40}, ear).x(), pixel({}, ear).x(), 0.01);
    EXPECT_GT(pixel({.field_of_view = 40}, kNoseTip + Eigen::Vector3d(20, 0, 0)).x(),
              pixel({}, kNoseTip + Eigen::Vector3d(20, 0, 0)).x() + 3);
}

}  // namespace
}  // namespace viaface
