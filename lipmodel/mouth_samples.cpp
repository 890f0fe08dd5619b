#include "lipmodel/mouth_samples.hpp"

#include <algorithm>
#include <cmath>

#include "lipmodel/lower_face.hpp"

namespace viaface {
namespace {

constexpr double kLipsWithin = 0.8, kSkinFrom = 1.5, kSkinWithin = 3;  // of the mouth's ellipse
constexpr double kOpeningWithin = 0.6, kOpeningHeight = 0.45, kCentre = 0.3;
constexpr double kDark = 0.5;  // of the mouth's brightness: what lies between the lips
constexpr int kRounds = 4;

double brightness(const Rgb& c) { return (c[0] + c[1] + c[2]) / 3.0; }

double mean_of(const std::vector<Rgb>& colours, double (*value)(const Rgb&)) {
    double sum = 0;
    for (const Rgb& c : colours) sum += value(c);
    return sum / static_cast<double>(std::max<std::size_t>(1, colours.size()));
}

MouthSamples by_place(std::span<const PlacedColour> colours) {
    MouthSamples guess;
    std::vector<Rgb> middle;
    for (const PlacedColour& c : colours) {
        if (c.far > kSkinFrom) guess.skin.push_back(c.colour);
        if (c.far < kLipsWithin) middle.push_back(c.colour);
    }
    const double dark = kDark * mean_of(middle, brightness),
                 red = 0.5 * (mean_of(guess.skin, pseudo_hue) + mean_of(middle, pseudo_hue));
    for (const PlacedColour& c : colours) {
        if (c.far >= kLipsWithin) continue;
        const bool is_dark = brightness(c.colour) < dark, is_red = pseudo_hue(c.colour) >= red;
        const bool opening =
            (is_dark && c.far < kOpeningWithin && c.height < kOpeningHeight) || (!is_red && c.far < kCentre);
        if (opening) guess.opening.push_back(c.colour);
        if (!opening && !is_dark) guess.lips.push_back(c.colour);
    }
    return guess;
}

double lips_expected(double far) { return 0.02 + 0.9 / (1 + std::exp((far - 1) / 0.15)); }

// What is not of the opening is lips or skin.
MouthSamples by_colour(std::span<const PlacedColour> colours, const ColourClasses& classes) {
    MouthSamples samples;
    for (const PlacedColour& c : colours) {
        const ClassFit fit = fit_of(classes, c.colour);
        if (fit.opening == 1 && c.far < kLipsWithin) continue;
        const double lips = lips_expected(c.far);
        (fit.lips * lips > fit.skin * (1 - lips) ? samples.lips : samples.skin).push_back(c.colour);
    }
    return samples;
}

}  // namespace

std::vector<PlacedColour> colours_about(const Picture& picture, const FaceInPicture& face,
                                        const MouthInPicture& mouth) {
    const LowerFace grid(face);
    const Eigen::Vector2d centre = mouth.centre - face.middle();
    const double centre_right = centre.dot(face.along()), centre_below = centre.dot(face.down());
    const double half_height = 0.5 * std::max(mouth.height, usual_mouth(face).height);
    std::vector<PlacedColour> colours;
    for (int j = 0; j < grid.down; ++j) {
        for (int i = 0; i < grid.across; ++i) {
            const double u = (grid.right(i) - centre_right) / (0.5 * mouth.width),
                         v = (grid.below(j) - centre_below) / half_height;
            if (std::hypot(u, v) >= kSkinWithin) continue;
            const Rgb colour = colour_near(picture, grid.place(grid.right(i), grid.below(j)));
            colours.push_back({colour, std::hypot(u, v), std::abs(v)});
        }
    }
    return colours;
}

ColourClasses first_classes(std::span<const PlacedColour> colours, const LearnClasses& learn) {
    ColourClasses classes = learn(by_place(colours));
    for (int round = 0; round < kRounds; ++round) {
        ColourClasses next = learn(by_colour(colours, classes));
        next.opening = std::move(classes.opening);  // its samples stay
        classes = std::move(next);
    }
    return classes;
}

}  // namespace viaface
