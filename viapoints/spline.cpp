#include "viapoints/spline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "viapoints/hermite.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;

// What a gap h adds to the rows (v, a) of the via points at its ends, and how it couples the left one's rows
// to the right one.
Matrix2d gap_left_block(double h) {
    Matrix2d m;
    m << 192 / (h * h * h), 36 / (h * h), 36 / (h * h), 9 / h;
    return m;
}

Matrix2d gap_right_block(double h) {
    Matrix2d m;
    m << 192 / (h * h * h), -36 / (h * h), -36 / (h * h), 9 / h;
    return m;
}

Matrix2d gap_coupling(double h) {
    Matrix2d m;
    m << 168 / (h * h * h), -24 / (h * h), 24 / (h * h), -3 / h;
    return m;
}

bool clamped(SplineEnd::Kind kind) { return kind == SplineEnd::Kind::kClamped; }

void require_rising(const std::vector<double>& time_s) {
    if (time_s.size() < 2) throw std::invalid_argument("a minimum-jerk spline needs at least two via points");
    for (std::size_t i = 0; i < time_s.size(); ++i) {
        if (!std::isfinite(time_s[i]) || (i > 0 && !(time_s[i] > time_s[i - 1]))) {
            throw std::invalid_argument("via time " + std::to_string(i) +
                                        " is not finite or not above the one before");
        }
    }
}

// The known values [2 x dimensions] of a clamped end.
Eigen::Matrix<double, 2, Eigen::Dynamic> known(const SplineEnd& end, Index dimensions) {
    Eigen::Matrix<double, 2, Eigen::Dynamic> rows = Eigen::MatrixXd::Zero(2, dimensions);
    for (const auto* value : {&end.velocity, &end.acceleration}) {
        if (value->size() == 0) continue;
        if (value->size() != dimensions)
            throw std::invalid_argument("a spline end has the wrong number of dimensions");
        rows.row(value == &end.velocity ? 0 : 1) = value->transpose();
    }
    return rows;
}

}  // namespace

// Scaled by D^-1/2 on both sides: L lower block bidiagonal with unit diagonal, C block diagonal, M = L C L^T.
struct MinimumJerkSystem::Block {
    Matrix2d inverse;  // of C_i
    Matrix2d lower;    // L of row i, column i - 1; zero for the first
    Vector2d scale;    // D^-1/2
};

MinimumJerkSystem::MinimumJerkSystem(std::vector<double> time_s, SplineEnd::Kind first, SplineEnd::Kind last)
    : time_s_(std::move(time_s)), first_(first), last_(last) {
    require_rising(time_s_);
    const std::size_t n = time_s_.size();
    std::vector<Block> factor(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool is_known = (i == 0 && clamped(first_)) || (i == n - 1 && clamped(last_));
        Matrix2d diagonal = Matrix2d::Zero();
        if (i > 0) diagonal += gap_right_block(time_s_[i] - time_s_[i - 1]);
        if (i + 1 < n) diagonal += gap_left_block(time_s_[i + 1] - time_s_[i]);
        if (is_known) diagonal.setIdentity();
        Block& block = factor[i];
        block.scale = diagonal.diagonal().cwiseSqrt().cwiseInverse();
        block.lower.setZero();
        Matrix2d scaled = block.scale.asDiagonal() * diagonal * block.scale.asDiagonal();
        if (i > 0 && !is_known && !(i == 1 && clamped(first_))) {
            const Block& before = factor[i - 1];
            const Matrix2d coupling = before.scale.asDiagonal() * gap_coupling(time_s_[i] - time_s_[i - 1]) *
                                      block.scale.asDiagonal();
            block.lower = coupling.transpose() * before.inverse;
            scaled -= block.lower * coupling;
        }
        block.inverse = scaled.inverse();
    }
    factor_ = std::make_shared<const std::vector<Block>>(std::move(factor));
}

// Rows 2i and 2i + 1 hold the right sides of via point i's two equations, unscaled; a clamped end's hold its
// known values.
RowMatrix MinimumJerkSystem::right_side(const RowMatrix& points, const SplineEnd& first,
                                        const SplineEnd& last) const {
    const Index n = points.rows();
    RowMatrix right = RowMatrix::Zero(2 * n, points.cols());
    for (Index i = 0; i + 1 < n; ++i) {
        const double h = time_s_[static_cast<std::size_t>(i + 1)] - time_s_[static_cast<std::size_t>(i)];
        const Eigen::RowVectorXd step = (points.row(i + 1) - points.row(i)) / (h * h * h);
        right.row(2 * i) += 360 / h * step;
        right.row(2 * i + 1) += 60 * step;
        right.row(2 * i + 2) += 360 / h * step;
        right.row(2 * i + 3) -= 60 * step;
    }
    const std::size_t end = time_s_.size() - 1;
    const auto at_first = known(first, points.cols()), at_last = known(last, points.cols());
    if (clamped(first_))
        right.middleRows(2, 2) -= gap_coupling(time_s_[1] - time_s_[0]).transpose() * at_first;
    if (clamped(last_))
        right.middleRows(2 * n - 4, 2) -= gap_coupling(time_s_[end] - time_s_[end - 1]) * at_last;
    if (clamped(first_)) right.topRows(2) = at_first;
    if (clamped(last_)) right.bottomRows(2) = at_last;
    return right;
}

MinimumJerkSystem::Derivatives MinimumJerkSystem::solve(const RowMatrix& points, const SplineEnd& first,
                                                        const SplineEnd& last) const {
    const Index n = static_cast<Index>(time_s_.size());
    if (points.rows() != n) throw std::invalid_argument("as many points as via times are needed");
    if (first.kind != first_ || last.kind != last_) {
        throw std::invalid_argument("a spline end is not of the kind that was factored");
    }
    if (n == 2 && !clamped(first_) && !clamped(last_)) {
        const RowMatrix slope = ((points.row(1) - points.row(0)) / (time_s_[1] - time_s_[0])).replicate(2, 1);
        return {slope, 0 * slope};
    }
    RowMatrix x = right_side(points, first, last);
    const std::vector<Block>& factor = *factor_;
    for (Index i = 0; i < n; ++i) {
        const Block& block = factor[static_cast<std::size_t>(i)];
        x.middleRows(2 * i, 2) = (block.scale.asDiagonal() * x.middleRows(2 * i, 2)).eval();
        if (i > 0) x.middleRows(2 * i, 2) -= block.lower * x.middleRows(2 * i - 2, 2);
    }
    // L^T's block above the diagonal is lower^T, so the back substitution needs no coupling of its own.
    for (Index i = n - 1; i >= 0; --i) {
        x.middleRows(2 * i, 2) =
            (factor[static_cast<std::size_t>(i)].inverse * x.middleRows(2 * i, 2)).eval();
        if (i + 1 < n) {
            x.middleRows(2 * i, 2) -=
                factor[static_cast<std::size_t>(i + 1)].lower.transpose() * x.middleRows(2 * i + 2, 2);
        }
    }
    Derivatives result{RowMatrix(n, points.cols()), RowMatrix(n, points.cols())};
    for (Index i = 0; i < n; ++i) {
        const Vector2d scale = factor[static_cast<std::size_t>(i)].scale;
        result.velocity.row(i) = scale[0] * x.row(2 * i);
        result.acceleration.row(i) = scale[1] * x.row(2 * i + 1);
    }
    return result;
}

MinimumJerkSpline::MinimumJerkSpline(ViaPointTrack track, SplineEnd first, SplineEnd last)
    : track_(std::move(track)),
      via_(MinimumJerkSystem(track_.time_s, first.kind, last.kind).solve(track_.points, first, last)) {}

Eigen::RowVectorXd MinimumJerkSpline::in_segment(std::size_t segment, double time_s, int derivative) const {
    const double begin = track_.time_s[segment], h = track_.time_s[segment + 1] - begin;
    const HermiteWeights w = hermite_weights(h, (time_s - begin) / h, derivative);
    const auto i = static_cast<Index>(segment);
    return w.p0 * track_.points.row(i) + w.v0 * via_.velocity.row(i) + w.a0 * via_.acceleration.row(i) +
           w.p1 * track_.points.row(i + 1) + w.v1 * via_.velocity.row(i + 1) +
           w.a1 * via_.acceleration.row(i + 1);
}

Eigen::VectorXd MinimumJerkSpline::at(double time_s, int derivative) const {
    return at(std::vector<double>{time_s}, derivative).row(0).transpose();
}

RowMatrix MinimumJerkSpline::at(const std::vector<double>& times_s, int derivative) const {
    if (derivative < 0 || derivative > 5) throw std::invalid_argument("a quintic's derivatives are 0 to 5");
    const std::vector<double>& via = track_.time_s;
    RowMatrix values(static_cast<Index>(times_s.size()), track_.points.cols());
    std::size_t segment = 0;
    if (!times_s.empty()) {
        const auto after = std::upper_bound(via.begin() + 1, via.end() - 1, times_s.front());
        segment = static_cast<std::size_t>(after - via.begin()) - 1;
    }
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        const double t = times_s[i];
        if (std::isnan(t) || (i > 0 && t < times_s[i - 1])) {
            throw std::invalid_argument("time " + std::to_string(i) +
                                        " to evaluate at is NaN or less than the one before");
        }
        const auto row = static_cast<Index>(i);
        if (t >= via.front() && t <= via.back()) {
            while (segment + 2 < via.size() && t >= via[segment + 1]) ++segment;
            values.row(row) = in_segment(segment, t, derivative);
        } else {
            const double held = derivative == 0 ? 1 : 0;
            values.row(row) = held * track_.points.row(t < via.front() ? 0 : track_.points.rows() - 1);
        }
    }
    return values;
}

double MinimumJerkSpline::jerk_cost() const {
    Eigen::RowVectorXd integral = Eigen::RowVectorXd::Zero(track_.points.cols());
    for (std::size_t i = 0; i + 1 < track_.time_s.size(); ++i) {
        const double h = track_.time_s[i + 1] - track_.time_s[i];
        // the jerk is j0 + j1 x + j2 x^2 on the segment, x from 0 to 1
        const Eigen::ArrayXXd j0 = in_segment(i, track_.time_s[i], 3).array();
        const Eigen::ArrayXXd j1 = h * in_segment(i, track_.time_s[i], 4).array();
        const Eigen::ArrayXXd j2 = h * h / 2 * in_segment(i, track_.time_s[i], 5).array();
        integral.array() += h * (j0 * j0 + j0 * j1 + (j1 * j1 + 2 * j0 * j2) / 3 + j1 * j2 / 2 + j2 * j2 / 5);
    }
    double cost = 0;
    for (const double part : integral) cost += std::isnan(part) ? 0 : part / 2;
    return cost;
}

}  // namespace viaface
