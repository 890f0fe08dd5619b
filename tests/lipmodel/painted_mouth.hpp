// Pictures of a made-up mouth, painted in the colours of its classes: what the tracker should see through.
#pragma once

#include <algorithm>
#include <vector>

#include "lipmodel/colour_classes.hpp"
#include "lipmodel/coloured_faces.hpp"
#include "mouths.hpp"

namespace viaface::test {

// The few modes that a tracker follows.
inline const Learned& learned_to_track() {
    static const Learned made{5, 0.05};
    return made;
}

struct Painting {
    int width = 200, height = 160;
    Pinhole camera{.focal_px = 800, .centre_px = {100, 80}};
    double noise = 0;   // standard deviation of a channel
    double shadow = 1;  // brightness of the picture's right half
    std::uint64_t seed = 1;
};

struct Painted {
    int width, height;
    std::vector<std::uint8_t> rgb;
    Picture picture() const { return {width, height, rgb}; }
};

inline const Eigen::Vector3d kSkinColour(190, 140, 120), kLipColour(165, 85, 90), kMouthColour(50, 20, 22);

// Four samples a pixel each way, so that edges are as soft as a camera's.
inline Painted paint(const Painting& how, const Nodes& lips, const LipPose& pose) {
    constexpr int kFine = 4;
    const Projected seen = project(how.camera, pose, lips);
    const auto faces = coloured_faces();
    std::vector<std::size_t> order(faces.size());
    const auto depth = [&](std::size_t f) {
        const Triangle& t = faces[f].corners;
        return seen.in_camera(t[0], 2) + seen.in_camera(t[1], 2) + seen.in_camera(t[2], 2);
    };
    for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
    std::ranges::stable_sort(order, std::greater<>(), depth);
    std::vector<Eigen::Vector3f> fine(static_cast<std::size_t>(how.width) * how.height * kFine * kFine,
                                      kSkinColour.cast<float>());
    const auto fill = [&](const Triangle& t, const Eigen::Vector3f& colour) {
        Eigen::Matrix<double, 3, 2> c;
        for (int i = 0; i < 3; ++i) c.row(i) = (seen.pixels.row(t[i]).array() + 0.5) * kFine;
        const auto edge = [&](int i, double x, double y) {
            const int j = (i + 1) % 3;
            return (c(j, 1) - c(i, 1)) * (x - c(i, 0)) - (c(j, 0) - c(i, 0)) * (y - c(i, 1));
        };
        const int top = std::max(0, static_cast<int>(c.col(1).minCoeff())),
                  bottom = std::min(how.height * kFine - 1, static_cast<int>(c.col(1).maxCoeff())),
                  left = std::max(0, static_cast<int>(c.col(0).minCoeff())),
                  right = std::min(how.width * kFine - 1, static_cast<int>(c.col(0).maxCoeff()));
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                if (edge(0, x + 0.5, y + 0.5) >= 0 && edge(1, x + 0.5, y + 0.5) >= 0 &&
                    edge(2, x + 0.5, y + 0.5) >= 0)
                    fine[static_cast<std::size_t>(y) * how.width * kFine + x] = colour;
            }
        }
    };
    for (const std::size_t f : order) {
        const ColourClass colour = faces[f].colour;
        fill(faces[f].corners, (colour == ColourClass::kLips   ? kLipColour
                                : colour == ColourClass::kSkin ? kSkinColour
                                                               : kMouthColour)
                                   .cast<float>());
    }
    Noise noise(how.seed);
    Painted made{how.width, how.height, std::vector<std::uint8_t>(3u * how.width * how.height)};
    for (int y = 0; y < how.height; ++y) {
        for (int x = 0; x < how.width; ++x) {
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            for (int i = 0; i < kFine * kFine; ++i)
                sum += fine[static_cast<std::size_t>(kFine * y + i / kFine) * how.width * kFine + kFine * x +
                            i % kFine];
            const double light = x >= how.width / 2 ? how.shadow : 1;
            for (int c = 0; c < 3; ++c) {
                const double value = light * sum[c] / (kFine * kFine) + how.noise * std::sqrt(3.0) * noise();
                made.rgb[3 * (static_cast<std::size_t>(y) * how.width + x) + c] =
                    static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l));
            }
        }
    }
    return made;
}

// A hundred picked samples of lips and skin, as the paper's were, in the lit part.
inline ColourClasses picked_classes(double noise_sd) {
    Noise noise(77);
    const auto samples = [&](const Eigen::Vector3d& colour) {
        std::vector<Rgb> made;
        for (int i = 0; i < 100; ++i) {
            Rgb rgb{};
            for (int c = 0; c < 3; ++c)
                rgb[c] = static_cast<std::uint8_t>(
                    std::clamp(std::lround(colour[c] + (4 + noise_sd) * std::sqrt(3.0) * noise()), 0l, 255l));
            made.push_back(rgb);
        }
        return made;
    };
    return learn_classes(samples(kLipColour), samples(kSkinColour));
}

}  // namespace viaface::test
