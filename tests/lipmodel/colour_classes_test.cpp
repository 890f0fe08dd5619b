#include "lipmodel/colour_classes.hpp"

#include <gtest/gtest.h>

#include "mouths.hpp"

namespace viaface {
namespace {

// Roughly Gaussian: the sum of twelve uniform numbers.
Rgb drawn(test::Noise& noise, const Eigen::Vector3d& mean, double sd) {
    Rgb made{};
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int i = 0; i < 12; ++i) sum += 0.5 * noise();
        made[c] = static_cast<std::uint8_t>(std::clamp(std::lround(mean[c] + sd * sum), 0l, 255l));
    }
    return made;
}

TEST(ColourClasses, AMixtureIsFoundAgain) {
    test::Noise noise(21);
    const std::vector<Eigen::Vector3d> means = {{70, 30, 35}, {150, 80, 85}, {220, 150, 150}};
    std::vector<Rgb> samples;
    for (int i = 0; i < 900; ++i) samples.push_back(drawn(noise, means[i % 3], 8));
    const ColourMixture found = learn_mixture(samples, 3);
    ASSERT_EQ(found.components().size(), 3u);
    for (int i = 0; i < 3; ++i) {  // in order of brightness, as they start
        const ColourGaussian& g = found.components()[i];
        EXPECT_NEAR(g.weight, 1.0 / 3, 0.01);
        EXPECT_LT((g.mean - means[i]).norm(), 2);
        EXPECT_LT((g.covariance - 64 * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 16);
    }
}

TEST(ColourClasses, SameSamplesGiveTheSameMixture) {
    test::Noise noise(22);
    std::vector<Rgb> samples;
    for (int i = 0; i < 120; ++i) samples.push_back(drawn(noise, {160, 90, 90}, 15));
    const ColourMixture once = learn_mixture(samples, 3), again = learn_mixture(samples, 3);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(once.components()[i].mean, again.components()[i].mean);
        EXPECT_EQ(once.components()[i].covariance, again.components()[i].covariance);
    }
}

TEST(ColourClasses, ADensityIntegratesToOne) {
    const ColourMixture mixture({{0.4, {100, 120, 130}, 90 * Eigen::Matrix3d::Identity()},
                                 {0.6, {140, 90, 110}, 60 * Eigen::Matrix3d::Identity()}});
    double sum = 0;
    for (int r = 0; r < 256; r += 4) {
        for (int g = 0; g < 256; g += 4) {
            for (int b = 0; b < 256; b += 4)
                sum += 64 * mixture.density({static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                                             static_cast<std::uint8_t>(b)});
        }
    }
    EXPECT_NEAR(sum, 1, 1e-3);
}

TEST(ColourClasses, FitsTellClassesApartAndLeaveOddColoursAlone) {
    test::Noise noise(23);
    std::vector<Rgb> lips, skin, opening;
    for (int i = 0; i < 100; ++i) {
        lips.push_back(drawn(noise, {165, 85, 90}, 10));
        skin.push_back(drawn(noise, {190, 140, 120}, 10));
        opening.push_back(drawn(noise, {50, 20, 22}, 10));
    }
    const ColourClasses two = learn_classes(lips, skin), three = learn_classes(lips, skin, opening);
    EXPECT_FALSE(two.opening.has_value());
    EXPECT_FALSE(learn_classes(lips, skin, std::span(opening).first(19)).opening.has_value());
    for (const ColourClasses& classes : {two, three}) {
        const ClassFit of_lips = fit_of(classes, {165, 85, 90}), of_skin = fit_of(classes, {190, 140, 120});
        EXPECT_EQ(of_lips.lips, 1);
        EXPECT_LT(of_lips.skin, 0.05);
        EXPECT_LT(of_lips.opening, 0.05);
        EXPECT_EQ(of_skin.skin, 1);
        EXPECT_LT(of_skin.lips, 0.05);
        const ClassFit odd = fit_of(classes, {0, 255, 0});
        EXPECT_GT(std::min({odd.lips, odd.skin, odd.opening}), 0.99);
    }
    EXPECT_GT(fit_of(two, {50, 20, 22}).lips, 0.99);  // it knows no opening: nothing is said
    EXPECT_LT(fit_of(three, {50, 20, 22}).lips, 0.05);
}

TEST(ColourClasses, RefuseTooFewSamplesAndFlatOnesAreHeldUp) {
    const std::vector<Rgb> few(29, Rgb{1, 2, 3}), flat(100, Rgb{100, 100, 100});
    EXPECT_THROW(learn_mixture(few, 3), std::invalid_argument);
    EXPECT_TRUE(std::isfinite(learn_mixture(flat, 3).density({100, 100, 100})));
    EXPECT_THROW(ColourMixture({}), std::invalid_argument);
    EXPECT_THROW(ColourMixture({{1, {0, 0, 0}, -Eigen::Matrix3d::Identity()}}), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
