// The lower face as a grid along and across the line of the eyes.
#pragma once

#include <algorithm>
#include <cmath>

#include "lipmodel/face_finder.hpp"

namespace viaface {

// The colour of the nearest pixel of the picture.
inline Rgb colour_near(const Picture& picture, const Eigen::Vector2d& place) {
    const int x = std::clamp(static_cast<int>(std::lround(place.x())), 0, picture.width - 1),
              y = std::clamp(static_cast<int>(std::lround(place.y())), 0, picture.height - 1);
    return picture.at(x, y);
}

struct LowerFace {
    static constexpr double kHalfAcross = 0.62, kFrom = 0.75, kTo = 1.6;  // distances of the eyes
    static constexpr int kSteps = 56;                                     // across

    const FaceInPicture& face;
    double step;  // px
    int across, down;

    explicit LowerFace(const FaceInPicture& f)
        : face(f),
          step(2 * kHalfAcross * f.eye_distance() / kSteps),
          across(kSteps + 1),
          down(static_cast<int>((kTo - kFrom) * f.eye_distance() / step) + 1) {}

    // From the middle between the eyes, px.
    double right(int i) const { return (i - kSteps / 2) * step; }
    double below(int j) const { return kFrom * face.eye_distance() + j * step; }
    Eigen::Vector2d place(double right, double below) const {
        return face.middle() + right * face.along() + below * face.down();
    }
};

}  // namespace viaface
