#include "lipmodel/reconstruction.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

Eigen::MatrixXd marked_rows(const Eigen::MatrixXd& columns) {
    Eigen::MatrixXd rows(LipMesh::kMarkedCoordinates, columns.cols());
    for (Eigen::Index i = 0; i < columns.cols(); ++i) rows.col(i) = marked_of(columns.col(i));
    return rows;
}

Eigen::MatrixXd without(const Eigen::MatrixXd& frames, Eigen::Index begin, Eigen::Index end) {
    Eigen::MatrixXd rest(frames.rows(), frames.cols() - (end - begin));
    rest << frames.leftCols(begin), frames.rightCols(frames.cols() - end);
    return rest;
}

double mean_square(const Eigen::MatrixXd& m) { return m.squaredNorm() / static_cast<double>(m.size()); }

ReconstructionError reconstruction_error(const LipBody& body, const LipModel& model, LipView view,
                                         const Eigen::MatrixXd& frames) {
    const double variance = model.left_over + model.noise_mm * model.noise_mm;
    const Eigen::MatrixXd p = ModeEstimator(model, coordinates_seen(view), variance).modes(frames);
    const Eigen::MatrixXd found = (model.modes * p).colwise() + model.mean;
    const Eigen::MatrixXd true_goals = frames.colwise() - marked_of(as_column(body.mesh.nodes));
    return {mean_square(found - body.spread * true_goals), mean_square(marked_rows(found) - true_goals)};
}

void add(ReconstructionError& sum, const ReconstructionError& error, double share) {
    sum.mesh += share * error.mesh;
    sum.points += share * error.points;
}

}  // namespace

std::vector<int> coordinates_seen(LipView view) {
    std::vector<int> seen;
    for (int i = 0; i < LipMesh::kMarkedCoordinates; ++i) {
        if (i % 3 != (view == LipView::kFrontal ? 2 : 0)) seen.push_back(i);
    }
    return seen;
}

ModeEstimator::ModeEstimator(const LipModel& model, std::span<const int> seen, double variance)
    : seen_(seen.begin(), seen.end()) {
    if (seen_.empty() || !(variance >= 0)) throw std::invalid_argument("ModeEstimator: nothing is seen");
    centre_ = Eigen::VectorXd(marked_of(lip_shape(model, Eigen::VectorXd::Zero(model.modes.cols()))))(seen_);
    const Eigen::MatrixXd moved = marked_rows(model.modes)(seen_, Eigen::all);
    if (variance == 0) {
        gain_ = pseudo_inverse(moved);
        return;
    }
    Eigen::MatrixXd normal = moved.transpose() * moved;
    normal.diagonal() += variance * model.variance.cwiseInverse();
    gain_ = solve_positive(normal, Eigen::MatrixXd(moved.transpose()));
}

Eigen::MatrixXd ModeEstimator::modes(const Eigen::MatrixXd& frames) const {
    if (frames.rows() != LipMesh::kMarkedCoordinates)
        throw std::invalid_argument("ModeEstimator: wants frames of sixteen points");
    return gain_ * (frames(seen_, Eigen::all).colwise() - centre_);
}

ViewErrors reconstruction_errors(const LipBody& body, const LipModel& model, const Eigen::MatrixXd& frames) {
    return {reconstruction_error(body, model, LipView::kFrontal, frames),
            reconstruction_error(body, model, LipView::kProfile, frames)};
}

std::vector<ViewErrors> cross_validated(const LipBody& body, const Eigen::MatrixXd& frames,
                                        const LipTraining& training, int folds) {
    if (folds < 2 || frames.cols() < 2 * folds)
        throw std::invalid_argument("cross_validated: wants two folds or more, two frames or more in each");
    std::vector<ViewErrors> sums(training.modes);
    for (int fold = 0; fold < folds; ++fold) {
        const Eigen::Index begin = frames.cols() * fold / folds, end = frames.cols() * (fold + 1) / folds;
        const LipModel model = learn_lips(body, without(frames, begin, end), training);
        const Eigen::MatrixXd left_out = frames.middleCols(begin, end - begin);
        const double share = static_cast<double>(end - begin) / static_cast<double>(frames.cols());
        sums.resize(std::min<std::size_t>(sums.size(), model.modes.cols()));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const auto errors =
                reconstruction_errors(body, with_modes(model, static_cast<int>(i) + 1), left_out);
            add(sums[i].frontal, errors.frontal, share);
            add(sums[i].profile, errors.profile, share);
        }
    }
    return sums;
}

double in_paper_units(double mean_square_mm2, const Nodes& rest) {
    const double scale = kPaperExtent / largest_extent(rest);
    return mean_square_mm2 * scale * scale;
}

}  // namespace viaface
