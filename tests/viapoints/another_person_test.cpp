#include "viapoints/another_person.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

// A talker at rest: some points of a face, mm, head frame.
Configuration talker_rest() {
    Configuration c = Configuration::Constant(std::numeric_limits<double>::quiet_NaN());
    const auto put = [&](int point, double x, double y, double z) {
        c.segment<3>(3 * point) = Vector3d(x, y, z);
    };
    put(kNose, 0, 36, 24);
    put(kChin, 0, -27, 4);
    put(kBorderTop, 0, 8, 10);
    put(kBorderBottom, 0, -6, 8);
    put(kLipCornerLeft, 27, -1, -5);
    put(kLipCornerRight, -27, -1, -5);
    put(kCheekUpperLeft, 42, 42, -12);
    put(kCheekUpperRight, -42, 42, -12);
    put(kTongueBody, 0, 3, -35);
    return c;
}

// The same face larger and in axes of its own: still until 1 s, then the jaw opens by 12 mm.
Motion person(const Eigen::Matrix3d& file_from_head, const Vector3d& scale) {
    Motion motion;
    motion.positions.resize(300, kCoordinates);
    for (int i = 0; i < 300; ++i) {
        const double t = i / 100.0;
        motion.time_s.push_back(t);
        Configuration c = talker_rest();
        const double open = t < 1 ? 0 : 6 * (1 - std::cos(8 * (t - 1)));
        c[3 * kChin + 1] -= open;
        c[3 * kBorderBottom + 1] -= open;
        for (int p = 0; p < kPoints; ++p)
            c.segment<3>(3 * p) =
                file_from_head * scale.cwiseProduct(c.segment<3>(3 * p)) + Vector3d(100, 200, 300);
        motion.positions.row(i) = c.transpose();
    }
    return motion;
}

Eigen::Matrix3d forward_left_up() {
    Eigen::Matrix3d head_from_file;
    head_from_file << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    return head_from_file;
}

TEST(AnotherPerson, IsFoundByRestAxesAndScale) {
    const Motion motion = person(forward_left_up().transpose(), Vector3d(1.25, 0.8, 1));
    const Person found = measure_person(motion, talker_rest());
    EXPECT_EQ(found.axes.name, "forward,left,up");
    EXPECT_LT(found.rest.to_s, 1.1);
    EXPECT_NEAR(found.scale.x(), 1 / 1.25, 1e-9);
    EXPECT_NEAR(found.scale.y(), 1 / 0.8, 1e-9);
    const Motion talker = as_talker(motion, found, talker_rest());
    EXPECT_LT((point_of(talker.at(0), kChin) - point_of(talker_rest(), kChin)).norm(), 1e-6);
    const Vector3d lowest(0, talker.positions.col(3 * kChin + 1).minCoeff() - talker_rest()[3 * kChin + 1],
                          0);
    EXPECT_NEAR(lowest.y(), -12, 0.01);
    EXPECT_TRUE(std::isnan(talker.positions(0, 3 * kJawLeft)));
}

TEST(AnotherPerson, EveryTurnOntoAxesIsFound) {
    for (const Vector3d& axis :
         {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(1, 1, 1).normalized().eval()}) {
        for (const double angle : {M_PI / 2, M_PI, 2 * M_PI / 3}) {
            const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
            const bool onto_axes = (turn.cwiseAbs().array().round().matrix() - turn.cwiseAbs()).norm() < 1e-9;
            if (!onto_axes) continue;
            const Person found = measure_person(person(turn, Vector3d::Ones()), talker_rest());
            EXPECT_LT((found.axes.head_from_file * turn - Eigen::Matrix3d::Identity()).norm(), 1e-9);
            EXPECT_LT(found.axes.fit_degrees, 1e-4);
        }
    }
}

TEST(AnotherPerson, AHeadTurnedAsideIsToldAndFitted) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vector3d::UnitY()).toRotationMatrix();
    const Motion motion = person(turn, Vector3d::Ones());
    EXPECT_NEAR(measure_person(motion, talker_rest()).axes.fit_degrees, 0.5 * 180 / M_PI, 0.1);
    PersonOptions options;
    options.axes = "fit";
    const Person fitted = measure_person(motion, talker_rest(), options);
    EXPECT_LT((fitted.axes.head_from_file * turn - Eigen::Matrix3d::Identity()).norm(), 1e-6);
}

TEST(AnotherPerson, AxesMayBeGivenLeftHandedOnesToo) {
    PersonOptions options;
    options.axes = "right, up, forward";
    const Person given =
        measure_person(person(Vector3d(-1, 1, 1).asDiagonal(), Vector3d::Ones()), talker_rest(), options);
    EXPECT_EQ(given.axes.name, "right,up,forward");
    for (const char* wrong :
         {"up,up,left", "left,up", "left,right,up", "x,y,z", "left,up,forward,back", ""}) {
        options.axes = wrong;
        EXPECT_THROW(
            measure_person(person(Eigen::Matrix3d::Identity(), Vector3d::Ones()), talker_rest(), options),
            InputError)
            << wrong;
    }
}

TEST(AnotherPerson, OneCornerMeasuresHalfAMouth) {
    Motion motion = person(Eigen::Matrix3d::Identity(), Vector3d(2, 1, 1));
    motion.positions.middleCols<3>(3 * kLipCornerRight).setConstant(std::nan(""));
    const Person found = measure_person(motion, talker_rest());
    EXPECT_NEAR(found.scale.x(), 0.5, 1e-9);
    EXPECT_EQ(found.width_from, "from one corner to the middle");
}

TEST(AnotherPerson, RestAndScaleMayBeGiven) {
    const Motion motion = person(Eigen::Matrix3d::Identity(), Vector3d::Ones());
    PersonOptions options;
    options.rest_s = {1.3, 1.45};
    options.scale = Vector3d(1, 2, 3);
    const Person given = measure_person(motion, talker_rest(), options);
    EXPECT_GE(given.rest.from_s, 1.3);
    EXPECT_LE(given.rest.to_s, 1.45);
    EXPECT_EQ(given.scale, Vector3d(1, 2, 3));
    options.rest_s = {5, 6};
    EXPECT_THROW(measure_person(motion, talker_rest(), options), InputError);
    options.rest_s = {};
    options.scale = Vector3d(1, 0, 1);
    EXPECT_THROW(measure_person(motion, talker_rest(), options), InputError);
}

TEST(AnotherPerson, RestLiesInTheQuietWhereThatIsKnown) {
    Motion motion = person(Eigen::Matrix3d::Identity(), Vector3d::Ones());
    for (int i = 0; i < 100;
         ++i)  // before he speaks the nose trembles; at 2.36 s he is closed again, and stiller
        motion.positions(i, 3 * kNose) += 0.3 * std::sin(2.0 * i);
    for (int i = 200; i < 260; ++i) motion.positions.row(i) = motion.positions.row(0);
    const Person anywhere = measure_person(motion, talker_rest());
    EXPECT_GE(anywhere.rest.from_s, 1.9);
    PersonOptions options;
    options.quiet_s = {{0, 0.8}, {2.9, 2.99}};
    const Person quiet = measure_person(motion, talker_rest(), options);
    EXPECT_LE(quiet.rest.to_s, 0.8);
    options.quiet_s = {{2.9, 2.99}};  // shorter than a rest: looked for everywhere
    EXPECT_EQ(measure_person(motion, talker_rest(), options).rest.from_s, anywhere.rest.from_s);
}

TEST(AnotherPerson, OneScaleIsForAllRecordings) {
    std::vector<Person> recordings;
    for (const double x : {1.2, 0.9, 1.0, 3.0, 0.8}) {
        const Motion motion = person(Eigen::Matrix3d::Identity(), Vector3d(1 / x, 2, 1));
        recordings.push_back(measure_person(motion, talker_rest()));
    }
    EXPECT_NEAR(median_scale(recordings).x(), 1.0, 1e-9);
    EXPECT_NEAR(median_scale(recordings).y(), 0.5, 1e-9);
}

TEST(AnotherPerson, WhatCannotBeToldIsRefused) {
    Motion motion = person(Eigen::Matrix3d::Identity(), Vector3d::Ones());
    for (int p = 0; p < kPoints; ++p) {
        if (p != kLipCornerLeft && p != kLipCornerRight)
            motion.positions.middleCols<3>(3 * p).setConstant(std::nan(""));
    }
    EXPECT_THROW(measure_person(motion, talker_rest()), InputError);  // axes, of two points
}

}  // namespace
}  // namespace viaface
