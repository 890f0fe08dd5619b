// Laws of the posterior and of its ascent, and lips of known modes found again in painted pictures.
#include <gtest/gtest.h>

#include <iostream>

#include "lipmodel/lip_ascent.hpp"
#include "lipmodel/lip_regions.hpp"
#include "painted_mouth.hpp"

namespace viaface {
namespace {

LipPose turned(double yaw_degrees) {
    return {.turn = {0, yaw_degrees * M_PI / 180, 0}, .shift = {3, -2, 1000}, .scale = {1, 1, 1}};
}

Eigen::VectorXd true_modes(int frame) {
    const test::Learned& l = test::learned_to_track();
    const MarkedPoints goal = l.frames.col(frame) - marked_of(as_column(l.body.mesh.nodes));
    return lip_modes_of(l.model, as_column(l.body.mesh.nodes) + l.body.spread * goal);
}

struct Scene {
    test::Painting how;
    LipPose pose;
    ColourClasses classes;

    // Classes picked in the light, as the paper's were.
    Scene(double noise, double shadow, double yaw)
        : how{.noise = noise, .shadow = shadow}, pose(turned(yaw)), classes(test::picked_classes(noise)) {}

    test::Painted painted(const Eigen::VectorXd& p, std::uint64_t seed) const {
        test::Painting seeded = how;
        seeded.seed = seed;
        return test::paint(seeded, as_lip_nodes(lip_shape(test::learned_to_track().model, p)), pose);
    }

    // Classes learned from the regions of one frame whose lips are known.
    Scene& with_own_classes() {
        const Eigen::VectorXd p = true_modes(25);  // open
        const auto first = painted(p, 3);
        const RegionSamples seen = sample_regions(
            how.camera, pose, as_lip_nodes(lip_shape(test::learned_to_track().model, p)), first.picture());
        classes = learn_classes(seen.lips, seen.skin, seen.opening);
        return *this;
    }

    ClassMaps maps(const Eigen::VectorXd& p, std::uint64_t seed) const {
        return class_maps(painted(p, seed).picture(), {20, 20, 160, 120}, classes, hamming_size(42));
    }
};

TEST(LipCamera, ProjectsAsAPinholeDoes) {
    const Pinhole camera{.focal_px = 500, .centre_px = {160, 120}};
    const Nodes point = Eigen::RowVector3d(10, 20, 30);
    const Projected seen = project(camera, {.shift = {0, 0, 1030}}, point);
    EXPECT_NEAR(seen.pixels(0, 0), 160 + 5, 1e-12);  // the talker's left is the picture's right
    EXPECT_NEAR(seen.pixels(0, 1), 120 - 10, 1e-12);
    EXPECT_NEAR(seen.in_camera(0, 2), 1000, 1e-12);
    EXPECT_THROW(project(camera, {}, point), std::runtime_error);
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d at(12, -7, 300), step = 1e-4 * Eigen::Vector3d::Unit(axis);
        const auto seen_at = [&](const Eigen::Vector3d& x) {
            return Eigen::Vector2d(500 * x.head<2>() / x.z());
        };
        EXPECT_LT(
            ((seen_at(at + step) - seen_at(at - step)) / 2e-4 - pinhole_slope(camera, at).col(axis)).norm(),
            1e-8);
    }
}

TEST(LipPosterior, FacesCoverSkinLipsAndOpening) {
    std::array<int, 3> count{};
    for (const ColouredFace& face : coloured_faces()) ++count[static_cast<int>(face.colour)];
    EXPECT_EQ(count[static_cast<int>(ColourClass::kSkin)], 128);
    EXPECT_EQ(count[static_cast<int>(ColourClass::kLips)], 192);
    EXPECT_EQ(count[static_cast<int>(ColourClass::kOpening)], 30);
}

// At places about a centre; sd: how far the parameters go.
void expect_gradient(const LipPosterior& posterior, const Eigen::VectorXd& centre,
                     const Eigen::VectorXd& sd) {
    test::Noise noise(41);
    int compared = 0;
    for (int tries = 0; tries < 30; ++tries) {
        const Eigen::VectorXd theta = centre + 0.5 * sd.cwiseProduct(noise.matrix(sd.size(), 1));
        const Eigen::VectorXd areas = posterior.areas(theta), gradient = posterior.gradient(theta);
        for (Eigen::Index i = 0; i < theta.size(); ++i) {
            const auto along = [&](double step) {
                return posterior.value_at_areas(theta + step * Eigen::VectorXd::Unit(theta.size(), i), areas);
            };
            // Within a pixel the function is smooth: where a centroid crosses into the next one, the
            // slopes before and behind differ, and the place does not count.
            const double h = 1e-5 * sd[i], tolerance = 1e-3 * (1 / sd[i] + std::abs(gradient[i]));
            const double ahead = (along(h) - along(0)) / h, behind = (along(0) - along(-h)) / h;
            if (std::abs(ahead - behind) > tolerance) continue;
            EXPECT_NEAR((along(h) - along(-h)) / (2 * h), gradient[i], tolerance);
            ++compared;
        }
    }
    EXPECT_GT(compared, 20 * sd.size());  // of 30
}

TEST(LipPosterior, GradientIsTheSlopeWithAreasHeld) {
    const Scene scene(10, 1, 20);
    const ClassMaps maps = scene.maps(true_modes(30), 5);
    const LipPosterior posterior(test::learned_to_track().model, scene.how.camera, scene.pose, maps,
                                 maps.independence);
    expect_gradient(posterior, true_modes(30), test::learned_to_track().model.variance.cwiseSqrt());
}

TEST(LipPosterior, FacesTurnedAwayDoNotCount) {
    const Scene scene(0, 1, 0);
    const ClassMaps maps = scene.maps(true_modes(30), 1);
    LipPose behind = scene.pose;
    behind.turn = {0, M_PI, 0};
    const LipPosterior front(test::learned_to_track().model, scene.how.camera, scene.pose, maps, 1),
        back(test::learned_to_track().model, scene.how.camera, behind, maps, 1);
    const Eigen::VectorXd p = true_modes(30);
    EXPECT_GT((front.areas(p).array() > 0).count(), 300);
    EXPECT_LT((back.areas(p).array() > 0).count(), 50);
}

TEST(LipPosterior, TheTruthIsMoreProbableThanOtherShapes) {
    const Scene scene(8, 1, 0);
    const ClassMaps maps = scene.maps(true_modes(30), 9);
    const LipPosterior posterior(test::learned_to_track().model, scene.how.camera, scene.pose, maps,
                                 maps.independence);
    const double here = posterior.value(true_modes(30));
    for (const int other : {10, 50, 90, 130, 170}) EXPECT_LT(posterior.value(true_modes(other)), here);
}

TEST(LipAscent, NeverGoesDown) {
    const Scene scene(15, 1, 30);
    for (int frame = 0; frame < 100; frame += 9) {
        const ClassMaps maps = scene.maps(true_modes(frame), frame);
        const LipPosterior posterior(test::learned_to_track().model, scene.how.camera, scene.pose, maps,
                                     maps.independence);
        const LipFit fit = climb(posterior, Eigen::VectorXd::Zero(5));
        EXPECT_LE(fit.iterations, 20);
        for (std::size_t i = 1; i < fit.climbed.size(); ++i) EXPECT_GT(fit.climbed[i], fit.climbed[i - 1]);
        EXPECT_EQ(fit.log_posterior, fit.climbed.back());
        EXPECT_EQ(posterior.value(fit.theta), fit.log_posterior);
    }
}

struct Recovery {
    double lips_mm = 0,
           plane_mm = 0;    // rms over the nodes of the lips: in space, and as the picture shows them
    double moved_mm = 0;    // rms of the truth about the mean shape: what doing nothing would give
    double iterations = 0;  // mean
};

// Frames follow each other; each fit starts from the one before.
Recovery recover(const Scene& scene, int frames) {
    const LipModel& model = test::learned_to_track().model;
    const int first = LipMesh::node(LipMesh::kBorderRing, 0), lips = LipMesh::kRingNodes - first;
    const Eigen::Matrix3d turn = camera_from_head(scene.pose);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(model.modes.cols());
    Recovery sum;
    for (int frame = 0; frame < frames; ++frame) {
        const Eigen::VectorXd truth = true_modes(frame);
        const ClassMaps maps = scene.maps(truth, 100 + frame);
        const LipFit fit =
            climb(LipPosterior(model, scene.how.camera, scene.pose, maps, maps.independence), p);
        p = fit.theta;
        const Nodes off = as_lip_nodes(model.modes * (p - truth)) * turn.transpose();
        sum.lips_mm += off.middleRows(first, lips).squaredNorm() / (3 * lips);
        sum.plane_mm += off.middleRows(first, lips).leftCols<2>().squaredNorm() / (2 * lips);
        sum.moved_mm += as_lip_nodes(model.modes * truth).middleRows(first, lips).squaredNorm() / (3 * lips);
        sum.iterations += fit.iterations;
    }
    return {std::sqrt(sum.lips_mm / frames), std::sqrt(sum.plane_mm / frames),
            std::sqrt(sum.moved_mm / frames), sum.iterations / frames};
}

void expect_recovered(const char* name, const Scene& scene, double most_mm, double most_plane_mm) {
    const Recovery found = recover(scene, 24);
    std::cout << name << ": lips within " << found.lips_mm << " mm rms in space, " << found.plane_mm
              << " in the picture's plane (they move " << found.moved_mm << "), " << found.iterations
              << " iterations a frame\n";
    EXPECT_LT(found.lips_mm, most_mm) << name;
    EXPECT_LT(found.plane_mm, most_plane_mm) << name;
    EXPECT_LT(found.iterations, 20) << name;
}

// The mouth is 36 px wide. Depth is not seen from the front: there the prior speaks.
TEST(LipTracking, KnownModesAreRecovered) {
    expect_recovered("clean", Scene(0, 1, 0), 1.6, 0.45);
    expect_recovered("noise of 12", Scene(12, 1, 0), 1.6, 0.45);
    expect_recovered("noise of 12, own classes", Scene(12, 1, 0).with_own_classes(), 1.3, 0.4);
    expect_recovered("noise of 12, yaw of 40 degrees", Scene(12, 1, 40), 0.75, 0.7);
    expect_recovered("noise of 12, yaw of 40 degrees, own classes", Scene(12, 1, 40).with_own_classes(), 0.6,
                     0.55);
}

TEST(LipTracking, KnownModesAreRecoveredInHalfShadow) {
    expect_recovered("half in shadow", Scene(12, 0.35, 0), 1.6, 0.5);
    expect_recovered("half in shadow, yaw of 40 degrees", Scene(12, 0.35, 40), 1.1, 1.0);
    // Classes of lit and dark parts tell lips from skin worse in depth than classes from the light alone.
    expect_recovered("half in shadow, own classes", Scene(12, 0.35, 0).with_own_classes(), 2.8, 0.5);
}

TEST(LipPosterior, GradientCoversThePoseToo) {
    const Scene scene(10, 1, 20);
    const ClassMaps maps = scene.maps(true_modes(30), 5);
    const LipPosterior posterior(test::learned_to_track().model, scene.how.camera, scene.pose, maps,
                                 maps.independence, {.turn = 0.1, .shift = 5, .scale = 0.1});
    ASSERT_EQ(posterior.parameters(), 5 + 9);
    Eigen::VectorXd sd(14);
    sd << test::learned_to_track().model.variance.cwiseSqrt(), Eigen::Vector3d::Constant(0.1),
        Eigen::Vector3d::Constant(5), Eigen::Vector3d::Constant(0.1);
    expect_gradient(posterior, posterior.start(true_modes(30)), sd);
}

TEST(LipTracking, ThePoseIsFollowed) {
    // The head moves by 4 mm and turns by 6 degrees; the lips are those of one frame.
    const Scene scene(12, 1, 10);
    const Eigen::VectorXd truth = true_modes(25);
    const ClassMaps maps = scene.maps(truth, 4);
    LipPose expected = scene.pose;
    expected.shift += Eigen::Vector3d(3, -2.5, 0);
    expected.turn += Eigen::Vector3d(0, 0, 0.1);
    const LipPosterior posterior(test::learned_to_track().model, scene.how.camera, expected, maps,
                                 maps.independence, {.turn = 0.1, .shift = 5, .scale = 0});
    const LipFit fit = climb(posterior, posterior.start(truth));
    const LipPose found = posterior.pose_of(fit.theta);
    const auto places = [&](const LipPose& pose, const Eigen::VectorXd& p) {
        return project(scene.how.camera, pose, as_lip_nodes(lip_shape(test::learned_to_track().model, p)))
            .pixels;
    };
    const Pixels right = places(scene.pose, truth);
    const auto off = [&](const Pixels& pixels) {
        return std::sqrt((pixels - right).topRows(LipMesh::kRingNodes).squaredNorm() / LipMesh::kRingNodes);
    };
    std::cout << "pose off by " << off(places(expected, truth)) << " px, found within "
              << off(places(found, posterior.modes_of(fit.theta))) << " px\n";
    EXPECT_LT(off(places(found, posterior.modes_of(fit.theta))), 1);
    EXPECT_GT(off(places(expected, truth)), 3);
}

}  // namespace
}  // namespace viaface
