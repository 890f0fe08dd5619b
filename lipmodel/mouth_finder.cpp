#include "lipmodel/mouth_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lipmodel/lower_face.hpp"

namespace viaface {
namespace {

// In distances of the eyes, from the middle between them.
constexpr double kMouthBelow = 1.1, kMouthWidth = 0.82, kMouthHeight = 0.32;
constexpr double kPlaceSdAcross = 0.3, kPlaceSdDown = 0.25;

double otsu(std::vector<double> values) {
    std::ranges::sort(values);
    const double total = std::accumulate(values.begin(), values.end(), 0.0);
    double low = 0, best = -1, cut = values.back();
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        low += values[i];
        const double n = static_cast<double>(i + 1), m = static_cast<double>(values.size()) - n;
        const double apart = low / n - (total - low) / m, between = n * m * apart * apart;
        if (between > best) {
            best = between;
            cut = 0.5 * (values[i] + values[i + 1]);
        }
    }
    return cut;
}

struct Moments {
    double weight = 0, right = 0, below = 0, right2 = 0, below2 = 0;
    void add(double w, double r, double b) {
        weight += w;
        right += w * r;
        below += w * b;
        right2 += w * r * r;
        below2 += w * b * b;
    }
};

struct Reds {
    LowerFace grid;
    std::vector<double> hues;  // [down x across]
    double cut;

    Reds(const Picture& picture, const FaceInPicture& face) : grid(face) {
        for (int j = 0; j < grid.down; ++j) {
            for (int i = 0; i < grid.across; ++i)
                hues.push_back(pseudo_hue(colour_near(picture, grid.place(grid.right(i), grid.below(j)))));
        }
        cut = otsu(hues);
    }
    double at(int i, int j) const { return hues[static_cast<std::size_t>(j) * grid.across + i]; }
};

}  // namespace

MouthInPicture usual_mouth(const FaceInPicture& face) {
    const double far = face.eye_distance();
    return {.centre = face.middle() + kMouthBelow * far * face.down(),
            .width = kMouthWidth * far,
            .height = kMouthHeight * far};
}

MouthInPicture find_mouth(const Picture& picture, const FaceInPicture& face) {
    const Reds reds(picture, face);
    const double far = face.eye_distance();
    double centre_right = 0, centre_below = kMouthBelow * far, sd_across = kPlaceSdAcross * far,
           sd_down = kPlaceSdDown * far;
    Moments m;
    for (int round = 0; round < 6; ++round) {
        m = {};
        for (int j = 0; j < reds.grid.down; ++j) {
            for (int i = 0; i < reds.grid.across; ++i) {
                if (reds.at(i, j) < reds.cut) continue;
                const double r = reds.grid.right(i), b = reds.grid.below(j);
                const double u = (r - centre_right) / sd_across, v = (b - centre_below) / sd_down;
                m.add(std::exp(-0.5 * (u * u + v * v)), r, b);
            }
        }
        if (!(m.weight > 5)) return usual_mouth(face);
        centre_right = m.right / m.weight;
        centre_below = m.below / m.weight;
        sd_across = 0.25 * far;
        sd_down = 0.13 * far;
    }
    // A lens of uniform red between parabolas has these spreads: width^2 / 20 and height^2 / 17.5, narrowed
    // by the window.
    const auto unwindowed = [](double variance, double window) {
        return std::sqrt(1 / std::max(1e-9, 1 / std::max(1e-9, variance) - 1 / (window * window)));
    };
    const double across = unwindowed(m.right2 / m.weight - centre_right * centre_right, sd_across),
                 down = unwindowed(m.below2 / m.weight - centre_below * centre_below, sd_down);
    return {.centre = reds.grid.place(centre_right, centre_below),
            .width = std::clamp(std::sqrt(20.0) * across, 0.6 * far, 1.0 * far),
            .height = std::clamp(std::sqrt(17.5) * down, 0.2 * far, 0.55 * far)};
}

double pseudo_hue(const Rgb& c) { return (c[0] + 5.0) / (c[0] + c[1] + 10.0); }

}  // namespace viaface
