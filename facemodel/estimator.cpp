#include "facemodel/estimator.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

std::vector<int> coordinates_of(const Presence& present) {
    std::vector<int> found;
    for (int point = 0; point < static_cast<int>(present.size()); ++point) {
        if (!present[point]) continue;
        for (int axis = 0; axis < 3; ++axis) found.push_back(3 * point + axis);
    }
    return found;
}

}  // namespace

Presence presence_of(const Eigen::VectorXd& points) {
    Presence present(points.size() / 3);
    for (std::size_t i = 0; i < present.size(); ++i) present[i] = points.segment<3>(3 * i).allFinite();
    return present;
}

Eigen::VectorXd EstimatorFor::estimate(const Eigen::VectorXd& points) const {
    if (points.size() != 3 * static_cast<Eigen::Index>(presence_.size())) {
        throw std::invalid_argument("estimate: another number of points than in training");
    }
    const Eigen::VectorXd measured = points(coordinates_);
    if (!measured.allFinite()) throw std::invalid_argument("estimate: a point of the pattern is missing");
    return mean_targets_ + matrix_ * (measured - mean_points_);
}

LinearEstimator::LinearEstimator(Eigen::MatrixXd points, Eigen::MatrixXd targets, EstimatorOptions options)
    : points_(std::move(points)), targets_(std::move(targets)), options_(options) {
    if (points_.cols() == 0 || points_.cols() != targets_.cols()) {
        throw std::invalid_argument("LinearEstimator: points and targets differ in their number of postures");
    }
    if (points_.rows() == 0 || points_.rows() % 3 != 0) {
        throw std::invalid_argument("LinearEstimator: points need three coordinates each");
    }
    if (!points_.allFinite() || !targets_.allFinite() || !(options_.noise_mm >= 0)) {
        throw std::invalid_argument("LinearEstimator: a training number that is not finite");
    }
}

EstimatorFor LinearEstimator::for_presence(const Presence& present) const {
    if (3 * static_cast<Eigen::Index>(present.size()) != points_.rows()) {
        throw std::invalid_argument("for_presence: another number of points than in training");
    }
    EstimatorFor made;
    made.presence_ = present;
    made.coordinates_ = coordinates_of(present);
    if (made.coordinates_.empty()) throw std::invalid_argument("for_presence: no point is present");

    const Eigen::MatrixXd measured = points_(made.coordinates_, Eigen::all);
    made.mean_points_ = measured.rowwise().mean();
    made.mean_targets_ = targets_.rowwise().mean();
    const auto [u, s, v] = thin_svd(measured.colwise() - made.mean_points_);
    const double ridge = static_cast<double>(points_.cols()) * options_.noise_mm * options_.noise_mm;
    Eigen::VectorXd gain = Eigen::VectorXd::Zero(s.size());
    for (; made.rank_ < s.size() && s[made.rank_] > options_.tolerance * s[0]; ++made.rank_) {
        gain[made.rank_] = s[made.rank_] / (s[made.rank_] * s[made.rank_] + ridge);
    }
    const Eigen::MatrixXd deviations = targets_.colwise() - made.mean_targets_;
    made.matrix_ = deviations * v * gain.asDiagonal() * u.transpose();
    return made;
}

Eigen::VectorXd LinearEstimator::estimate(const Eigen::VectorXd& points) const {
    return for_presence(presence_of(points)).estimate(points);
}

}  // namespace viaface
