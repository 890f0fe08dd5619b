#include "synth/picture/portrait.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "momo_face.hpp"
#include "simple_faces.hpp"

namespace viaface {
namespace {

using testing::add_ball;
using testing::add_square;
using testing::bytes;
using testing::kMiddleY;
using testing::kMiddleZ;
using testing::momo;
using testing::two_balls;
using testing::wandering;

const View kSmallBlack{.width = 256, .height = 256, .background = Rgb{0, 0, 0}};
constexpr double kMillimetresPerPixel = 300.0 / 256;

// Pixels covered by the face: over white and over black a pixel differs by what shows through.
double covered(const Face& face, View view) {
    view.background = Rgb{0, 0, 0};
    const std::vector<std::uint8_t> on_black = bytes(Portrait(face, view).draw(face.rest));
    view.background = Rgb{255, 255, 255};
    const std::vector<std::uint8_t> on_white = bytes(Portrait(face, view).draw(face.rest));
    double sum = 0;
    for (std::size_t i = 0; i < on_black.size(); i += 4) sum += 1 - (on_white[i] - on_black[i]) / 255.0;
    return sum;
}

TEST(Portrait, BackgroundIsExact) {
    Face face;
    add_square(face, Material::kLash, 1e-3);
    View view = kSmallBlack;
    view.background = Rgb{10, 128, 255};
    Portrait portrait(face, view);
    const std::vector<std::uint8_t> all = bytes(portrait.draw(face.rest));
    std::size_t other = 0;
    for (std::size_t i = 0; i < all.size(); i += 4) {
        other += all[i] != 10 || all[i + 1] != 128 || all[i + 2] != 255 || all[i + 3] != 255;
    }
    EXPECT_LE(other, 1u);
}

// Four samples per pixel: an edge is placed to a quarter of a pixel at worst.
TEST(Portrait, SquareCoversItsArea) {
    for (const double side : {30.0, 77.7, 150.0}) {
        Face face;
        add_square(face, Material::kTeeth, side);
        const double pixels = side / kMillimetresPerPixel;
        EXPECT_NEAR(covered(face, kSmallBlack), pixels * pixels, pixels) << side;
    }
}

// A ball's outline is a circle; the flat facets of 32 rings cost less than half a per cent.
TEST(Portrait, BallCoversItsDisc) {
    Face face;
    const double radius = 60, distance = 300 / 2 / std::tan(8.5 * std::numbers::pi / 180);
    add_ball(face, Material::kSkin, radius, {0, kMiddleY, kMiddleZ}, 32);
    const double seen =
        radius / std::sqrt(1 - radius * radius / (distance * distance)) / kMillimetresPerPixel;
    const double disc = std::numbers::pi * seen * seen;
    EXPECT_NEAR(covered(face, kSmallBlack), disc, 0.005 * disc + seen);
}

TEST(Portrait, NearerIsInFront) {
    Face face;
    add_square(face, Material::kCloth, 100, 0);
    add_square(face, Material::kTeeth, 50, 20);
    Portrait portrait(face, kSmallBlack);
    const auto middle = [](const FrameView& v) { return v.top_row[v.stride * (v.height / 2) + 2 * v.width]; };
    const int in_front = middle(portrait.draw(face.rest));
    Nodes posed = face.rest;
    posed.bottomRows(4).col(2).array() -= 40;
    const int behind = middle(portrait.draw(posed));
    EXPECT_GT(in_front, behind + 60);
}

TEST(Portrait, SeenFromBehindShowsNothing) {
    Face face;
    add_square(face, Material::kSkin, 100);
    View view = kSmallBlack;
    view.yaw = 180;
    Portrait portrait(face, view);
    const std::vector<std::uint8_t> all = bytes(portrait.draw(face.rest));
    for (std::size_t i = 0; i < all.size(); i += 4) ASSERT_EQ(all[i], 0);
}

TEST(Portrait, DrawingWhatChangedEqualsDrawingAll) {
    const Face face = two_balls();
    for (const View& view : {View{.width = 250, .height = 200, .yaw = 25}, View{.width = 128, .height = 300},
                             View{.width = 200, .height = 200, .roll = 30, .background = Rgb{0, 177, 64}}}) {
        Portrait changed(face, view), all(face, view);
        for (int step = 0; step < 8; ++step) {
            const Nodes posed = wandering(face, step);
            const auto alone = bytes(Portrait(face, view).draw(posed));
            ASSERT_EQ(bytes(changed.draw(posed)), alone) << step;
            ASSERT_EQ(bytes(all.draw(posed, Portrait::Redraw::kAll)), alone) << step;
        }
    }
}

// Of the way of a jaw that opens: what the mouth's inside and what all else goes.
Nodes opened(double inside, double outside) {
    const auto opens = std::ranges::find(momo().shapes, "jawOpen", &NamedShape::name);
    Nodes posed = momo().rest + outside * opens->delta;
    for (const FacePart& part : momo().parts) {
        if (part.material < Material::kMouth || part.material > Material::kTongue) continue;
        posed.middleRows(part.first_node, part.nodes) +=
            (inside - outside) * opens->delta.middleRows(part.first_node, part.nodes);
    }
    return posed;
}

// Teeth and tongue come and go behind the lips, come back to where they were, and move while they are hidden.
TEST(Portrait, AMouthThatOpensAndShutsEqualsItselfDrawnWhole) {
    for (const View& view :
         {View{.width = 160, .height = 160}, View{.width = 160, .height = 120, .yaw = 40}}) {
        Portrait changed(momo(), view);
        for (const auto& [inside, outside] :
             {std::pair{0.0, 0.0}, std::pair{0.3, 0.3}, std::pair{0.5, 0.3}, std::pair{0.05, 0.05},
              std::pair{0.0, 0.0}, std::pair{0.6, 0.0}, std::pair{0.6, 0.0}, std::pair{0.6, 0.6},
              std::pair{0.0, 0.6}, std::pair{0.0, 0.0}, std::pair{0.3, 0.3}}) {
            const Nodes posed = opened(inside, outside);
            ASSERT_EQ(bytes(changed.draw(posed)), bytes(Portrait(momo(), view).draw(posed)))
                << inside << ' ' << outside;
        }
    }
}

TEST(Portrait, TheReferenceToo) {
    const View view{.width = 160, .height = 160};
    const Drawing reference{.renderer = Renderer::kOsmesa};
    Portrait changed(momo(), view, reference);
    for (const double share : {0.0, 0.3, 0.1}) {
        const Nodes posed = opened(share, share);
        ASSERT_EQ(bytes(changed.draw(posed)), bytes(Portrait(momo(), view, reference).draw(posed))) << share;
    }
}

TEST(Portrait, LessThanAHairIsNoMove) {
    const Face face = two_balls();
    Portrait portrait(face, kSmallBlack);
    const Nodes grained = (face.rest / Portrait::kGrain).array().round() * Portrait::kGrain;
    const auto before = bytes(portrait.draw(grained));
    const Nodes moved = grained.array() + 0.4 * Portrait::kGrain;
    EXPECT_EQ(bytes(portrait.draw(moved, Portrait::Redraw::kAll)), before);
}

TEST(Portrait, SamePoseSameBytesInEveryThread) {
    const Face face = two_balls();
    std::vector<std::vector<std::uint8_t>> drawn(2);
    const auto draw = [&](int which) {
        Portrait portrait(face, View{.width = 200, .height = 200});
        for (int step = 0; step < 4; ++step) drawn[which] = bytes(portrait.draw(wandering(face, step)));
    };
    std::thread first(draw, 0), second(draw, 1);
    first.join();
    second.join();
    EXPECT_EQ(drawn[0], drawn[1]);
    Portrait again(face, View{.width = 200, .height = 200});
    EXPECT_EQ(bytes(again.draw(wandering(face, 3))), drawn[0]);
}

TEST(Portrait, TwoInOneThreadDoNotDisturbEachOther) {
    const Face face = two_balls();
    Portrait one(face, kSmallBlack), other(face, View{.width = 100, .height = 80});
    const auto before = bytes(one.draw(face.rest));
    other.draw(face.rest);
    EXPECT_EQ(bytes(one.draw(face.rest, Portrait::Redraw::kAll)), before);
}

TEST(Portrait, WhatDoesNotFitIsRefused) {
    Face face = two_balls();
    Portrait portrait(face, kSmallBlack);
    EXPECT_THROW(portrait.draw(face.rest.topRows(3)), std::invalid_argument);
    Nodes lost = face.rest;
    lost(5, 1) = std::nan("");
    EXPECT_THROW(portrait.draw(lost), std::invalid_argument);
    face.parts[0].triangles[0][2] = 1 << 20;
    EXPECT_THROW(Portrait(face, kSmallBlack), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
