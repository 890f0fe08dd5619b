#include "lipmodel/class_maps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace viaface {
namespace {

constexpr double kLeast = 0.01;  // a class that seems impossible is not: hairs, glints, teeth
constexpr double kPaperSize = 7, kPaperMouth = 80;  // px

// Smoothed over a picture whose edge pixels go on outwards.
LogMap smoothed_log(const cv::Mat& fit, const PictureBox& box, const std::vector<double>& kernel) {
    cv::Mat smooth;
    cv::sepFilter2D(fit, smooth, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
    LogMap map{box, std::vector<float>(static_cast<std::size_t>(box.width) * box.height)};
    for (int y = 0; y < box.height; ++y) {
        for (int x = 0; x < box.width; ++x) {
            const double value = std::clamp<double>(smooth.at<float>(y, x), 0, 1);
            map.values[static_cast<std::size_t>(y) * box.width + x] =
                static_cast<float>(std::log(kLeast + (1 - kLeast) * value));
        }
    }
    return map;
}

}  // namespace

MapSample LogMap::at(const Eigen::Vector2d& place) const {
    const double x = std::clamp(place.x() - box.left, 0.0, box.width - 1.0);
    const double y = std::clamp(place.y() - box.top, 0.0, box.height - 1.0);
    const int column = std::min(static_cast<int>(x), std::max(0, box.width - 2));
    const int row = std::min(static_cast<int>(y), std::max(0, box.height - 2));
    const int right = std::min(column + 1, box.width - 1), below = std::min(row + 1, box.height - 1);
    const auto value = [&](int r, int c) -> double {
        return values[static_cast<std::size_t>(r) * box.width + c];
    };
    const double a = value(row, column), b = value(row, right), c = value(below, column),
                 d = value(below, right);
    const double u = x - column, v = y - row;
    const bool inside_x = x == place.x() - box.left, inside_y = y == place.y() - box.top;
    return {(1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d),
            {inside_x ? (1 - v) * (b - a) + v * (d - c) : 0, inside_y ? (1 - u) * (c - a) + u * (d - b) : 0}};
}

int hamming_size(double mouth_width_px) {
    const int half = static_cast<int>(std::lround((kPaperSize * mouth_width_px / kPaperMouth - 1) / 2));
    return 2 * std::max(1, half) + 1;
}

std::vector<double> hamming_kernel(int size) {
    if (size < 1 || size % 2 == 0) throw std::invalid_argument("hamming_kernel: a size that is not odd");
    std::vector<double> kernel(size, 1.0);
    double sum = 0;
    for (int i = 0; i < size; ++i) {
        if (size > 1) kernel[i] = 0.54 - 0.46 * std::cos(2 * std::numbers::pi * i / (size - 1));
        sum += kernel[i];
    }
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

ClassMaps class_maps(const Picture& picture, const PictureBox& box, const ColourClasses& classes,
                     int kernel_size) {
    if (box.left < 0 || box.top < 0 || box.width < 1 || box.height < 1 ||
        box.left + box.width > picture.width || box.top + box.height > picture.height)
        throw std::invalid_argument("class_maps: a box that is not in the picture");
    cv::Mat lips(box.height, box.width, CV_32F), skin = lips.clone(), opening = lips.clone();
    for (int y = 0; y < box.height; ++y) {
        for (int x = 0; x < box.width; ++x) {
            const ClassFit fit = fit_of(classes, picture.at(box.left + x, box.top + y));
            lips.at<float>(y, x) = static_cast<float>(fit.lips);
            skin.at<float>(y, x) = static_cast<float>(fit.skin);
            opening.at<float>(y, x) = static_cast<float>(fit.opening);
        }
    }
    const std::vector<double> kernel = hamming_kernel(kernel_size);
    double squares = 0;
    for (const double weight : kernel) squares += weight * weight;
    return {smoothed_log(lips, box, kernel), smoothed_log(skin, box, kernel),
            smoothed_log(opening, box, kernel), squares * squares};
}

}  // namespace viaface
