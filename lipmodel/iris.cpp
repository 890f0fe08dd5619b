#include "lipmodel/iris.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace viaface {
namespace {

constexpr int kAcross = 24;         // px, about: what is larger is made smaller first
constexpr double kSmoothing = 1.0;  // px
constexpr double kSteep = 0.3;      // standard deviations above the mean slope

cv::Mat smooth_part(const Picture& picture, const PictureBox& part, double shrink) {
    const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));  // read only
    cv::Mat grey, made;
    cv::cvtColor(rgb(cv::Rect(part.left, part.top, part.width, part.height)), grey, cv::COLOR_RGB2GRAY);
    if (shrink > 1) cv::resize(grey, grey, {}, 1 / shrink, 1 / shrink, cv::INTER_AREA);
    grey.convertTo(made, CV_32F);
    cv::GaussianBlur(made, made, {}, kSmoothing);
    return made;
}

struct Slope {
    Eigen::Vector2d place, way;
    double size;
};

std::vector<Slope> steep_slopes(const cv::Mat& grey) {
    std::vector<Slope> slopes;
    double sum = 0, squares = 0;
    for (int y = 1; y + 1 < grey.rows; ++y) {
        for (int x = 1; x + 1 < grey.cols; ++x) {
            const Eigen::Vector2d g(grey.at<float>(y, x + 1) - grey.at<float>(y, x - 1),
                                    grey.at<float>(y + 1, x) - grey.at<float>(y - 1, x));
            const double size = g.norm();
            slopes.push_back({{x, y}, size > 0 ? Eigen::Vector2d(g / size) : g, size});
            sum += size;
            squares += size * size;
        }
    }
    const double n = static_cast<double>(slopes.size()), mean = sum / n;
    const double least = mean + kSteep * std::sqrt(std::max(0.0, squares / n - mean * mean));
    std::erase_if(slopes, [&](const Slope& slope) { return !(slope.size > least); });
    return slopes;
}

double centredness(const std::vector<Slope>& slopes, const Eigen::Vector2d& centre) {
    double sum = 0;
    for (const Slope& slope : slopes) {
        const Eigen::Vector2d d = slope.place - centre;
        const double far = d.norm();
        if (far > 0) sum += std::pow(std::max(0.0, d.dot(slope.way) / far), 2);
    }
    return sum;
}

// Between samples: the top of the parabola through three.
double between(double before, double at, double after) {
    const double bend = before - 2 * at + after;
    return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
}

}  // namespace

Eigen::Vector2d iris_in(const Picture& picture, const PictureBox& part) {
    if (part.left < 0 || part.top < 0 || part.width < 3 || part.height < 3 ||
        part.left + part.width > picture.width || part.top + part.height > picture.height)
        throw std::invalid_argument("iris_in: a part that is not in the picture");
    const double shrink = std::max(1.0, double{1} * part.width / kAcross);
    const cv::Mat grey = smooth_part(picture, part, shrink);
    const std::vector<Slope> slopes = steep_slopes(grey);
    cv::Mat votes(grey.size(), CV_64F);
    cv::Point best;
    for (int y = 0; y < grey.rows; ++y) {
        for (int x = 0; x < grey.cols; ++x) {
            votes.at<double>(y, x) = centredness(slopes, {x, y}) * (255 - grey.at<float>(y, x));
            if (votes.at<double>(y, x) > votes.at<double>(best.y, best.x)) best = {x, y};
        }
    }
    Eigen::Vector2d place(best.x, best.y);
    if (best.x > 0 && best.x + 1 < grey.cols)
        place.x() += between(votes.at<double>(best.y, best.x - 1), votes.at<double>(best.y, best.x),
                             votes.at<double>(best.y, best.x + 1));
    if (best.y > 0 && best.y + 1 < grey.rows)
        place.y() += between(votes.at<double>(best.y - 1, best.x), votes.at<double>(best.y, best.x),
                             votes.at<double>(best.y + 1, best.x));
    return Eigen::Vector2d(part.left, part.top) +
           Eigen::Vector2d((place.array() + 0.5) * Eigen::Array2d(double(part.width) / grey.cols,
                                                                  double(part.height) / grey.rows) -
                           0.5);
}

}  // namespace viaface
