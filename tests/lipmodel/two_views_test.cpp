#include "lipmodel/two_views.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "mouths.hpp"

namespace viaface {
namespace {

// Straight ahead at 600 mm, turned about the vertical by `yaw` degrees; 1200 px focal length.
Projection camera(double yaw) {
    Eigen::Matrix3d lens;
    lens << 1200, 0, 320, 0, -1200, 240, 0, 0, 1;
    Eigen::Matrix<double, 3, 4> pose;
    pose.leftCols<3>() = Eigen::AngleAxisd(yaw * M_PI / 180, Eigen::Vector3d::UnitY()).toRotationMatrix();
    pose.row(2) *= -1;  // the camera looks along -z of the head
    pose.col(3) << 0, 0, 600;
    return lens * pose;
}

TEST(TwoViews, GiveThePlaceBack) {
    test::Noise noise(3);
    for (int i = 0; i < 50; ++i) {
        const Eigen::Vector3d place = 40 * noise.matrix(3, 1);
        const Projection a = camera(0), b = camera(-50 - i);
        const Triangulated found = triangulate(a, projected(a, place), b, projected(b, place));
        EXPECT_LT((found.place - place).norm(), 1e-9 * 600);
        EXPECT_LT(found.error_px, 1e-8);
    }
}

TEST(TwoViews, NoiseOfAPixelIsAboutHalfAMillimetre) {
    // 1200 px at 600 mm: 2 px a mm; a pixel's noise is 0.5 mm across, and at 90 degrees as much in depth.
    test::Noise noise(4);
    const Projection a = camera(0), b = camera(90);
    double sum = 0;
    constexpr int kTries = 200;
    for (int i = 0; i < kTries; ++i) {
        const Eigen::Vector3d place = 30 * noise.matrix(3, 1);
        const Eigen::Vector2d off_a = std::sqrt(3.0) * noise.matrix(2, 1),
                              off_b = std::sqrt(3.0) * noise.matrix(2, 1);
        const auto found = triangulate(a, projected(a, place) + off_a, b, projected(b, place) + off_b);
        sum += (found.place - place).squaredNorm();
    }
    const double rms = std::sqrt(sum / kTries / 3);
    EXPECT_GT(rms, 0.3);
    EXPECT_LT(rms, 0.6);
}

TEST(TwoViews, RefuseRaysOnOneLine) {
    const Projection a = camera(0);
    const Eigen::Vector3d place(1, 2, 3);
    EXPECT_THROW(triangulate(a, projected(a, place), a, projected(a, place)), std::runtime_error);
}

}  // namespace
}  // namespace viaface
