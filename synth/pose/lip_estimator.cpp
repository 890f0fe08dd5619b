#include "synth/pose/lip_estimator.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "synth/pose/seats.hpp"

namespace viaface {
namespace {

constexpr int kColumns = LipGrid::kColumns, kInnerRow = LipGrid::kRows - 1;
constexpr double kLipNoise = 0.3;  // mm: the ridge

using PointRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Eight = Eigen::Matrix<double, 8, 1>;  // of the points round a contour
using EightByEight = Eigen::Matrix<double, 8, 8>;

constexpr int after(int k) { return (k + 1) % 8; }
constexpr int before(int k) { return (k + 7) % 8; }

// From each column to the next, round the ring.
Eight gaps_between(const Eight& columns) {
    Eight gaps;
    for (int k = 0; k < 8; ++k) {
        gaps[k] = std::fmod(columns[after(k)] - columns[k] + kColumns, kColumns);
        if (gaps[k] < 0.5) throw std::invalid_argument("the lip points are out of order");
    }
    return gaps;
}

// From values at the columns to second derivatives there, of the closed spline through them.
EightByEight bend_of(const Eight& gaps) {
    EightByEight system = EightByEight::Zero(), right = system;
    for (int k = 0; k < 8; ++k) {
        const double one = gaps[before(k)], other = gaps[k];
        system(k, before(k)) = one;
        system(k, k) = 2 * (one + other);
        system(k, after(k)) = other;
        right(k, before(k)) += 6 / one;
        right(k, k) -= 6 / one + 6 / other;
        right(k, after(k)) += 6 / other;
    }
    return system.inverse() * right;
}

// Spreads values at eight columns over the whole ring: a closed cubic spline. [40 x 8]
Eigen::MatrixXd spread(const Eight& columns) {
    const Eight gaps = gaps_between(columns);
    const EightByEight bend = bend_of(gaps);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(kColumns, 8);
    for (int c = 0; c < kColumns; ++c) {
        for (int k = 0; k < 8; ++k) {
            const double span = gaps[k];
            const double t = std::fmod(c - columns[k] + 2 * kColumns, kColumns) / span, s = 1 - t;
            if (t < 0 || t >= 1) continue;
            weights.row(c) =
                span * span / 6 * ((s * s * s - s) * bend.row(k) + (t * t * t - t) * bend.row(after(k)));
            weights(c, k) += s;
            weights(c, after(k)) += t;
        }
    }
    return weights;
}

// Where eight points from `first` on sit along a row of the lips.
Eight columns_of(const Nodes& rest, const LipGrid& lips, int row, const Configuration& points, int first) {
    Eight columns;
    for (int k = 0; k < 8; ++k) {
        columns[k] = column_of(seat_on(rest, ring_of(lips, row), point_of(points, first + k)), lips, row);
    }
    return columns;
}

// The middle and the inner contour, as in PoseTraining::contours.
Eigen::VectorXd contours_at(const Nodes& rest, const LipGrid& lips) {
    Eigen::VectorXd contours(PoseTraining::kContourNumbers);
    for (int c = 0; c < kColumns; ++c) {
        contours.segment<3>(3 * c) = rest.row(lips.node(LipGrid::kMiddleRow, c)).transpose();
        contours.segment<3>(3 * (kColumns + c)) = rest.row(lips.node(kInnerRow, c)).transpose();
    }
    return contours;
}

}  // namespace

LipEstimator::LipEstimator(const Nodes& rest, const LipGrid& lips, const PoseTraining& training) {
    const Eigen::MatrixXd from_border = spread(columns_of(rest, lips, 0, training.rest, kFirstLipPoint));
    const Eigen::MatrixXd from_inner = spread(columns_of(rest, lips, kInnerRow, training.rest, kInnerTop));
    spread_ = Eigen::MatrixXd::Zero(2 * kColumns, kLipPoints);
    spread_.topLeftCorner(kColumns, 8) = 0.5 * from_border;
    spread_.topRightCorner(kColumns, 8) = 0.5 * from_inner;
    spread_.bottomRightCorner(kColumns, 8) = from_inner;
    rest_points_ = training.rest.segment<3 * kLipPoints>(3 * kFirstLipPoint);
    rest_ = contours_at(rest, lips);
    const Eigen::MatrixXd points = training.configurations.middleRows(3 * kFirstLipPoint, 3 * kLipPoints);
    Eigen::MatrixXd left_out = training.contours;
    for (Eigen::Index k = 0; k < points.cols(); ++k) left_out.col(k) -= spread_out(points.col(k));
    residual_ = LinearEstimator(points, left_out, {kLipNoise}).for_presence(Presence(kLipPoints, true));
}

Eigen::VectorXd LipEstimator::contours(const Eigen::VectorXd& points) const {
    return spread_out(points) + residual_.estimate(points);
}

Eigen::VectorXd LipEstimator::spread_out(const Eigen::VectorXd& points) const {
    const Eigen::VectorXd moved = points - rest_points_;
    const PointRows spread = spread_ * Eigen::Map<const PointRows>(moved.data(), kLipPoints, 3);
    return rest_ + Eigen::Map<const Eigen::VectorXd>(spread.data(), spread.size());
}

}  // namespace viaface
