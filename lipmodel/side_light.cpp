#include "lipmodel/side_light.hpp"

#include <algorithm>
#include <cmath>

#include "base/median.hpp"
#include "lipmodel/lower_face.hpp"

namespace viaface {
namespace {

// In distances of the eyes, from the middle between them.
constexpr double kNearest = 0.2, kFarthest = 0.6, kFrom = 0.6, kTo = 1.5, kStep = 0.04;

Eigen::Vector3d log_colour(const Picture& picture, const Eigen::Vector2d& place) {
    const Rgb c = colour_near(picture, place);
    return {std::log(c[0] + 1.0), std::log(c[1] + 1.0), std::log(c[2] + 1.0)};
}

}  // namespace

SideLight side_light(const Picture& picture, const FaceInPicture& face) {
    const double far = face.eye_distance();
    std::vector<double> slopes[3];
    for (double down = kFrom; down < kTo; down += kStep) {
        for (double across = kNearest; across < kFarthest; across += kStep) {
            const Eigen::Vector2d under = face.middle() + down * far * face.down(),
                                  way = across * far * face.along();
            const Eigen::Vector3d slope =
                (log_colour(picture, under + way) - log_colour(picture, under - way)) / (2 * across * far);
            for (int c = 0; c < 3; ++c) slopes[c].push_back(slope[c]);
        }
    }
    return {{median(slopes[0]), median(slopes[1]), median(slopes[2])}};
}

std::vector<std::uint8_t> evened(const Picture& picture, const PictureBox& box, const SideLight& light,
                                 const FaceAxis& axis) {
    std::vector<std::uint8_t> rgb(picture.rgb.begin(), picture.rgb.end());
    const Eigen::Array3d step = (-light.slope * axis.along.x()).array().exp();
    for (int y = box.top; y < box.top + box.height; ++y) {
        const double first = (Eigen::Vector2d(box.left, y) - axis.middle).dot(axis.along);
        Eigen::Array3d share = (-light.slope * first).array().exp();
        std::uint8_t* at = &rgb[3 * (static_cast<std::size_t>(y) * picture.width + box.left)];
        for (int x = 0; x < box.width; ++x, share *= step) {
            for (int c = 0; c < 3; ++c, ++at)
                *at = static_cast<std::uint8_t>(std::clamp(std::lround(*at * share[c]), 0l, 255l));
        }
    }
    return rgb;
}

}  // namespace viaface
