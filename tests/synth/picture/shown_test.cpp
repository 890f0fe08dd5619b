#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "momo_face.hpp"
#include "simple_faces.hpp"
#include "synth/picture/point_lights.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/picture/shown_face.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::bytes;
using testing::momo;

int red(const FrameView& frame, int x, int row) { return frame.top_row[frame.stride * row + 4 * x]; }

// The middle of a dot's light, pixels from the upper left corner.
Vector2d middle_of_light(const FrameView& frame, double& light) {
    Vector2d sum = Vector2d::Zero();
    light = 0;
    for (int row = 0; row < frame.height; ++row) {
        for (int x = 0; x < frame.width; ++x) {
            light += red(frame, x, row);
            sum += red(frame, x, row) * Vector2d(x + 0.5, row + 0.5);
        }
    }
    return sum / light;
}

Vector2d dot_at(const View& view, const Vector3d& place) {
    PointLights lights(view);
    double light = 0;
    return middle_of_light(lights.draw(std::array{place}), light);
}

const Vector3d kPlaces[] = {{0, 0, 0}, {25, -4, 10}, {-52.3, 40.1, -30}, {3.3, -71.7, -5}, {60, 60, -100}};

TEST(PointLights, OrthographicDotsAreAsFarApartAsThePlacesTimesTheScale) {
    for (const double scale : {1.0, 2.0, 2.75}) {
        const View view{
            .width = 720, .height = 720, .shown = Shown::kPoints, .orthographic = true, .px_per_mm = scale};
        const Vector2d first = dot_at(view, kPlaces[0]);
        for (const Vector3d& place : kPlaces) {
            const Vector2d apart = dot_at(view, place) - first;
            EXPECT_NEAR(apart.x(), scale * (place - kPlaces[0]).x(), 0.05);
            EXPECT_NEAR(apart.y(), -scale * (place - kPlaces[0]).y(), 0.05);
        }
    }
}

// Turned by yaw a place at depth z moves sideways by z sin(yaw).
TEST(PointLights, TheScaleHoldsWhereverTheHeadIsTurned) {
    const View view{.yaw = 37, .shown = Shown::kPoints, .orthographic = true, .px_per_mm = 2};
    const double turn = 37 * M_PI / 180;
    const Vector2d first = dot_at(view, kPlaces[0]);
    for (const Vector3d& place : kPlaces) {
        const Vector3d way = place - kPlaces[0];
        const double right = std::cos(turn) * way.x() + std::sin(turn) * way.z();
        EXPECT_NEAR(dot_at(view, place).x() - first.x(), 2 * right, 0.05);
    }
}

TEST(PointLights, ADotHasItsArea) {
    const View view{.shown = Shown::kPoints, .orthographic = true, .px_per_mm = 4};
    double light = 0;
    PointLights lights(view);
    middle_of_light(lights.draw(std::array{kPlaces[1]}), light);
    const double radius = 4 * PointLights::kRadius;
    EXPECT_NEAR(light / 255, M_PI * radius * radius, 2 * M_PI * radius * 0.1);  // its border by a tenth
}

// In perspective the scale is that of the depth of the picture's middle.
TEST(View, ScaleAtTheMiddleInPerspective) {
    const View view{.shown = Shown::kPoints, .px_per_mm = 1.5};
    const Vector2d apart = dot_at(view, {40, 41, -106}) - dot_at(view, {-40, 41, -106});
    EXPECT_NEAR(apart.x(), 80 * 1.5, 0.1);
    EXPECT_GT((dot_at(view, {40, 41, 0}) - dot_at(view, {-40, 41, 0})).x(), 80 * 1.5 * 1.05);
}

TEST(View, WhatIsShownAndTheScaleAreChecked) {
    EXPECT_THROW(shown_of("nose"), InputError);
    for (const double bad : {0.0, -1.0, 51.0, std::nan("")}) {
        View view;
        view.px_per_mm = bad;
        EXPECT_THROW(check(view), InputError) << bad;
    }
    for (std::size_t i = 0; i < kShownNames.size(); ++i)
        EXPECT_EQ(shown_of(kShownNames[i]), static_cast<Shown>(i));
}

double highest(const Face& face, Material material) {
    double top = -1e9;
    for (const FacePart& part : face.parts) {
        if (part.material != material) continue;
        for (const Triangle& t : part.triangles) {
            for (const int node : t) top = std::max(top, face.rest(node, 1));
        }
    }
    return top;
}

double lowest_eye(const Face& face) {
    double low = 1e9;
    for (const FacePart& part : face.parts) {
        if (part.material == Material::kEye)
            low = std::min(low, face.rest.middleRows(part.first_node, part.nodes).col(1).minCoeff());
    }
    return low;
}

TEST(ShownFace, LipsAndLowerFaceHoldNothingOfTheEyes) {
    for (const Shown shown : {Shown::kLips, Shown::kLowerFace}) {
        const Face part = shown_face(momo(), {.shown = shown}).face;
        EXPECT_EQ(highest(part, Material::kEye), -1e9);
        EXPECT_EQ(highest(part, Material::kLash), -1e9);
        EXPECT_EQ(highest(part, Material::kCloth), -1e9);
        EXPECT_EQ(highest(part, Material::kLips), highest(momo(), Material::kLips));
        EXPECT_GT(highest(part, Material::kSkin), -1e9);
        EXPECT_LT(highest(part, Material::kSkin), lowest_eye(momo()));
    }
    const Face lips = shown_face(momo(), {.shown = Shown::kLips}).face;
    EXPECT_LT(highest(lips, Material::kSkin), highest(momo(), Material::kLips) + 12);
}

double area(const Face& face, Material material) {
    double sum = 0;
    for (const FacePart& part : face.parts) {
        if (part.material != material) continue;
        for (const Triangle& t : part.triangles) {
            const Vector3d a = face.rest.row(t[0]), b = face.rest.row(t[1]), c = face.rest.row(t[2]);
            sum += (b - a).cross(c - a).norm() / 2;
        }
    }
    return sum;
}

// Both sides of a cut are the whole again, and the nodes of a cut lie on it, in other postures on the edges
// that were cut.
TEST(CutFace, TakesAwayWhatLiesBeyondTheLevelAndNothingElse) {
    const auto none = [](Material) { return false; };
    const Eigen::VectorXd field = 3.1 - momo().rest.col(1).array() - 0.2 * momo().rest.col(0).array();
    const CutFace below = cut_skin(momo(), field, none), above = cut_skin(momo(), -field, none);
    EXPECT_NEAR(area(below.face, Material::kSkin) + area(above.face, Material::kSkin),
                area(momo(), Material::kSkin), 1e-6 * area(momo(), Material::kSkin));
    EXPECT_EQ(area(below.face, Material::kLips), 0);
    ASSERT_GT(below.nodes.size(), 100u);
    const auto shape = std::ranges::find(momo().shapes, "jawOpen", &NamedShape::name);
    const Nodes posed = momo().rest + shape->delta, with = with_cut(posed, below.nodes);
    for (std::size_t i = 0; i < below.nodes.size(); ++i) {
        const Eigen::Index node = momo().rest.rows() + static_cast<Eigen::Index>(i);
        const Vector3d at = below.face.rest.row(node), now = with.row(node);
        EXPECT_NEAR(3.1 - at.y() - 0.2 * at.x(), 0, 1e-9);
        const Vector3d from = posed.row(below.nodes[i].from), to = posed.row(below.nodes[i].to);
        EXPECT_NEAR((now - from).norm() + (to - now).norm(), (to - from).norm(), 1e-9);
    }
    EXPECT_THROW(with_cut(momo().rest.topRows(9), below.nodes), std::invalid_argument);
}

// Seen from the front the lower face ends in one row of pixels, at its share of that row.
TEST(Portrait, TheLowerFaceEndsInALevelSoftEdge) {
    const Rgb green{0, 177, 64};
    const View view{.width = 400,
                    .height = 400,
                    .background = green,
                    .shown = Shown::kLowerFace,
                    .orthographic = true,
                    .px_per_mm = 2.27};
    Portrait portrait(momo(), view);
    const FrameView frame = portrait.draw(momo().rest);
    const auto covered = [&](int x, int row) {  // about; skin's red is some 200
        return red(frame, x, row) / 200.0;
    };
    int first_row = 0;
    while (covered(200, first_row) < 0.05) ++first_row;
    int between = 0;
    for (int x = 120; x < 280; ++x) {
        EXPECT_LT(covered(x, first_row - 1), 0.05) << x;
        EXPECT_GT(covered(x, first_row + 1), 0.5) << x;
        between += covered(x, first_row) > 0.1 && covered(x, first_row) < 0.9;
    }
    EXPECT_GT(between, 100);
}

// What a view leaves out is background.
TEST(Portrait, TheLipsViewShowsTheFaceInItsLowerPartAlone) {
    View view{.width = 200,
              .height = 200,
              .background = Rgb{0, 177, 64},
              .shown = Shown::kLips,
              .orthographic = true,
              .px_per_mm = 1};
    Portrait portrait(momo(), view);
    const FrameView frame = portrait.draw(momo().rest);
    const auto is_background = [&](int x, int row) {
        const std::uint8_t* p = frame.top_row + frame.stride * row + 4 * x;
        return p[0] == 0 && p[1] == 177 && p[2] == 64;
    };
    const double top = highest(momo(), Material::kLips);  // mm; the picture's middle is at -20 mm
    for (int row = 0; row < 100 - 20 - (top + 12); ++row) {
        for (int x = 0; x < 200; ++x) ASSERT_TRUE(is_background(x, row)) << x << " " << row;
    }
    EXPECT_FALSE(is_background(100, 100));
}

TEST(Portrait, WithoutTextureAMaterialHasOneColour) {
    const Face plain = shown_face(momo(), {.texture = false}).face;
    for (int i = 0; i < kMaterials; ++i) {
        const bool shape = static_cast<Material>(i) == Material::kLash;
        EXPECT_EQ(plain.surfaces[i].base_colour.pixels.empty(), !shape);
    }
    EXPECT_EQ(plain.surfaces[int(Material::kLash)].base_colour.pixels,
              momo().surfaces[int(Material::kLash)].base_colour.pixels);
}

// Under the bar all is black; elsewhere nothing differs.
TEST(Portrait, TheBarHidesTheEyesAndNothingElse) {
    const View open{.width = 256, .height = 256};
    View barred = open;
    barred.eyes_occluded = true;
    Portrait one(momo(), open), other(momo(), barred);
    const auto seen = bytes(one.draw(momo().rest)), hidden = bytes(other.draw(momo().rest));
    int black = 0, differ = 0;
    for (std::size_t i = 0; i < seen.size(); i += 4) {
        const bool dark = hidden[i] == 0 && hidden[i + 1] == 0 && hidden[i + 2] == 0;
        black += dark;
        for (int c = 0; c < 3; ++c) differ += !dark && seen[i + c] != hidden[i + c];
    }
    EXPECT_EQ(differ, 0);
    // The box of the eyes and a quarter of its height around it, seen from 943 mm before the picture's
    // middle.
    Eigen::Vector3d low = Vector3d::Constant(1e9), high = -low;
    for (const FacePart& part : momo().parts) {
        if (part.material != Material::kEye) continue;
        const auto ball = momo().rest.middleRows(part.first_node, part.nodes);
        low = low.cwiseMin(ball.colwise().minCoeff().transpose());
        high = high.cwiseMax(ball.colwise().maxCoeff().transpose());
    }
    const Vector3d box = high - low;
    const double nearer = 1004 / (1004 - 106 - (low.z() + high.z()) / 2), mm = 300.0 / 256 / nearer;
    const double bar = (box.x() + 0.5 * box.y()) * 1.5 * box.y();
    EXPECT_NEAR(black * mm * mm, bar, 0.15 * bar);
}

TEST(Portrait, TheWireframeIsInkOnPaper) {
    const View view{.width = 300, .height = 300, .shown = Shown::kWireframe};
    Portrait portrait(momo(), view);
    const auto all = bytes(portrait.draw(momo().rest));
    std::size_t dark = 0;
    for (std::size_t i = 0; i < all.size(); i += 4) {
        ASSERT_NEAR(all[i], all[i + 2], 6);
        dark += all[i] < 128;
    }
    EXPECT_GT(dark, 300u * 300 / 50);
    EXPECT_LT(dark, 300u * 300 / 3);
    EXPECT_EQ(bytes(Portrait(momo(), view).draw(momo().rest)), all);
}

TEST(Portrait, OrthographicEqualsTheReference) {
    const View view{.width = 200, .height = 200, .yaw = 30, .orthographic = true};
    const auto ours = bytes(Portrait(momo(), view).draw(momo().rest));
    const auto reference = bytes(Portrait(momo(), view, {.renderer = Renderer::kOsmesa}).draw(momo().rest));
    double squares = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) squares += std::pow(double(ours[i]) - reference[i], 2);
    EXPECT_GT(10 * std::log10(255 * 255 / (squares / (0.75 * double(ours.size())))), 36);
}

}  // namespace
}  // namespace viaface
