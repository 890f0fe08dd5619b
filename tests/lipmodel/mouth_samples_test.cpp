#include "lipmodel/mouth_samples.hpp"

#include <gtest/gtest.h>

#include "lipmodel/side_light.hpp"
#include "mouths.hpp"

namespace viaface {
namespace {

constexpr int kWidth = 200, kHeight = 220, kMiddle = 100;
const FaceInPicture kFace{.left_eye = {74, 92}, .right_eye = {126, 92}, .eyes_seen = true};

// Both halves mirror each other, but for light that rises to the right by `slope` a px.
std::vector<std::uint8_t> lit_from_the_right(double slope) {
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double pattern = 1 + 0.2 * std::cos(0.1 * std::abs(x - kMiddle)) * std::sin(0.13 * y),
                         light = std::exp(slope * (x - kMiddle));
            for (const double base : {150, 110, 90})
                rgb.push_back(static_cast<std::uint8_t>(std::lround(base * pattern * light)));
        }
    }
    return rgb;
}

TEST(SideLight, IsFoundAndTakenOutOfAFaceWhoseHalvesMirrorEachOther) {
    const std::vector<std::uint8_t> rgb = lit_from_the_right(0.004);
    const Picture picture{kWidth, kHeight, rgb};
    const SideLight light = side_light(picture, kFace);
    // A channel is rounded to a half of at least 70, two of them at least 20 px apart are compared; the 1
    // under the logarithm takes off 1 in 70.
    for (const double slope : light.slope) EXPECT_NEAR(slope, 0.004, 2 * 0.5 / 70 / 20 + 0.004 / 70);
    const PictureBox box{40, 100, 121, 80};
    const std::vector<std::uint8_t> even = evened(picture, box, light, {kFace.middle(), kFace.along()});
    const Picture seen{kWidth, kHeight, even};
    for (int y = box.top; y < box.top + box.height; ++y) {
        for (int x = 1; x <= 60; ++x) {
            const Rgb left = seen.at(kMiddle - x, y), right = seen.at(kMiddle + x, y);
            // The error of the slope over 120 px, and rounding before and after.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(left[c], right[c], 0.00077 * 120 * 180 / 2 + 2);
        }
    }
    EXPECT_EQ(seen.at(39, 120), picture.at(39, 120));
    EXPECT_EQ(seen.at(100, 99), picture.at(100, 99));
}

TEST(SideLight, LightFromTheFrontLeavesThePictureAsItIs) {
    const std::vector<std::uint8_t> rgb = lit_from_the_right(0);
    const Picture picture{kWidth, kHeight, rgb};
    const SideLight light = side_light(picture, kFace);
    EXPECT_EQ(light.slope.norm(), 0);
    EXPECT_EQ(evened(picture, {0, 0, kWidth, kHeight}, light, {kFace.middle(), kFace.along()}), rgb);
}

// An upper lip redder than the skin, a lower lip lighter and no redder, a dark line between them.
TEST(MouthSamples, PaleLipsAreLips) {
    test::Noise noise(3);
    const auto near = [&](double r, double g, double b) {
        const double shade = 6 * noise();
        return Rgb{static_cast<std::uint8_t>(r + shade + 2 * noise()),
                   static_cast<std::uint8_t>(g + shade + 2 * noise()),
                   static_cast<std::uint8_t>(b + shade + 2 * noise())};
    };
    std::vector<PlacedColour> colours;
    int pale = 0;
    for (double v = -3; v < 3; v += 0.08) {
        for (double u = -3; u < 3; u += 0.08) {
            const double far = std::hypot(u, v);
            if (far >= 3) continue;
            const bool lower = v > 0.2 && far < 1;
            const Rgb colour = far >= 1             ? near(190, 140, 110)
                               : std::abs(v) <= 0.2 ? near(40, 20, 20)
                               : lower              ? near(215, 160, 140)
                                                    : near(150, 80, 75);
            colours.push_back({colour, far, std::abs(v)});
            pale += lower;
        }
    }
    const ColourClasses found = first_classes(
        colours, [](const MouthSamples& s) { return learn_classes(s.lips, s.skin, s.opening); });
    int pale_lips = 0, dark_opening = 0, dark = 0, other_opening = 0;
    for (const PlacedColour& c : colours) {
        const ClassFit fit = fit_of(found, c.colour);
        const bool is_dark = c.colour[0] < 60;
        pale_lips += c.colour[0] > 200 && fit.lips == 1;
        dark += is_dark;
        dark_opening += is_dark && fit.opening == 1;
        other_opening += !is_dark && fit.opening == 1;
    }
    EXPECT_GT(pale_lips, 0.9 * pale);
    EXPECT_GT(dark_opening, 0.9 * dark);
    EXPECT_LT(other_opening, 0.1 * pale);
}

}  // namespace
}  // namespace viaface
