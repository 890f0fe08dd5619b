#include "lipmodel/head_follower.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

constexpr int kMostPlaces = 3000, kIterations = 12, kMargin = 24;
constexpr double kSmoothing = 1.5;  // px
constexpr double kSettled = 0.01;   // px

cv::Mat smooth_grey(const Picture& picture, const cv::Rect& part) {
    const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));  // read only
    cv::Mat grey, made;
    cv::cvtColor(rgb(part), grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(made, CV_32F);
    cv::GaussianBlur(made, made, {}, kSmoothing);
    return made;
}

double at(const cv::Mat& m, double x, double y) {
    x = std::clamp(x, 0.0, m.cols - 1.001);
    y = std::clamp(y, 0.0, m.rows - 1.001);
    const int c = static_cast<int>(x), r = static_cast<int>(y);
    const double u = x - c, v = y - r;
    const float *top = m.ptr<float>(r), *below = m.ptr<float>(std::min(r + 1, m.rows - 1));
    const int next = std::min(c + 1, m.cols - 1);
    return (1 - v) * ((1 - u) * top[c] + u * top[next]) + v * ((1 - u) * below[c] + u * below[next]);
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
    const double size = x.norm() * y.norm();
    return size > 0 ? x.dot(y) / size : 0;
}

// then -> now(step^-1(then)): what the template's own change undoes.
Similarity without(const Similarity& now, double da, double db, const Eigen::Vector2d& step) {
    const double c = 1 + da, s = db, size = c * c + s * s;
    const double ia = c / size, ib = -s / size;
    Similarity made = now;
    made.a = now.a * ia - now.b * ib;
    made.b = now.b * ia + now.a * ib;
    const Eigen::Vector2d back(-(made.a * step.x() - made.b * step.y()),
                               -(made.b * step.x() + made.a * step.y()));
    made.shift = now.shift + back;
    return made;
}

}  // namespace

Eigen::Vector2d Similarity::operator()(const Eigen::Vector2d& then) const {
    const Eigen::Vector2d d = then - centre;
    return centre + shift + Eigen::Vector2d(a * d.x() - b * d.y(), b * d.x() + a * d.y());
}
double Similarity::scale() const { return std::hypot(a, b); }
double Similarity::roll() const { return std::atan2(b, a); }

HeadFollower::HeadFollower(const Picture& first, const PictureBox& patch) {
    if (patch.left < 0 || patch.top < 0 || patch.width < kLeastSide || patch.height < kLeastSide ||
        patch.left + patch.width > first.width || patch.top + patch.height > first.height)
        throw std::invalid_argument("HeadFollower: a patch that is not in the picture");
    const cv::Mat grey = smooth_grey(first, {patch.left, patch.top, patch.width, patch.height});
    centre_ = {patch.left + 0.5 * (patch.width - 1), patch.top + 0.5 * (patch.height - 1)};
    const int step = 1 + static_cast<int>(std::sqrt(double(patch.width) * patch.height / kMostPlaces));
    std::vector<Eigen::Matrix<double, 6, 1>> rows;
    std::vector<double> values;
    for (int y = 1; y + 1 < patch.height; y += step) {
        for (int x = 1; x + 1 < patch.width; x += step) {
            const double gx = 0.5 * (grey.at<float>(y, x + 1) - grey.at<float>(y, x - 1)),
                         gy = 0.5 * (grey.at<float>(y + 1, x) - grey.at<float>(y - 1, x));
            const Eigen::Vector2d d = Eigen::Vector2d(patch.left + x, patch.top + y) - centre_;
            places_.push_back(d);
            values.push_back(grey.at<float>(y, x));
            rows.emplace_back(gx, gy, gx * d.x() + gy * d.y(), gy * d.x() - gx * d.y(), values.back(), 1);
        }
    }
    brightness_ = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    slopes_.resize(brightness_.size(), 6);
    for (std::size_t i = 0; i < rows.size(); ++i)
        slopes_.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    Eigen::MatrixXd normal = slopes_.transpose() * slopes_;
    normal.diagonal().array() += 1e-6 * normal.trace();
    solver_ = solve_positive(normal, Eigen::MatrixXd(slopes_.transpose()));
}

Followed HeadFollower::follow(const Picture& now, const Similarity& start) const {
    const double reach = 2 * places_.front().norm() * start.scale() + kMargin;
    const Eigen::Vector2d middle = start(centre_);
    const cv::Rect part = cv::Rect(static_cast<int>(middle.x() - reach), static_cast<int>(middle.y() - reach),
                                   static_cast<int>(2 * reach), static_cast<int>(2 * reach)) &
                          cv::Rect(0, 0, now.width, now.height);
    if (part.width < 8 || part.height < 8) return {start, 0};
    const cv::Mat grey = smooth_grey(now, part);
    const Eigen::Vector2d corner(part.x, part.y);
    Similarity move = start;
    Eigen::VectorXd seen(brightness_.size());
    const auto look = [&] {
        for (Eigen::Index i = 0; i < seen.size(); ++i) {
            const Eigen::Vector2d place = move(centre_ + places_[static_cast<std::size_t>(i)]) - corner;
            seen[i] = at(grey, place.x(), place.y());
        }
    };
    look();
    for (int i = 0; i < kIterations; ++i) {
        const Eigen::VectorXd d = solver_ * (seen - brightness_);
        move = without(move, d[2], d[3], d.head<2>());
        look();
        if (d.head<2>().norm() < kSettled) break;
    }
    if (!(move.scale() > 0.3 && move.scale() < 3)) return {start, 0};
    return {move, correlation(seen, brightness_)};
}

}  // namespace viaface
