#include "lipmodel/modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

struct Spectrum {
    Eigen::VectorXd mean_goal;  // [48]
    Eigen::VectorXd values;     // falling
    Eigen::MatrixXd vectors;    // [48 x 48], in the span
    Eigen::VectorXd noise;      // variance along each that noise of the points gives
};

// The spread as Q R with Q [612 x 48] orthonormal: displacements lie in the span of Q, so that the
// eigenvectors of R_u are Q times those of a matrix of 48 x 48.
Spectrum spectrum_of(const ThinQr& span, const Eigen::MatrixXd& goals, double noise_mm) {
    Spectrum found;
    found.mean_goal = goals.rowwise().mean();
    const Eigen::MatrixXd centred = goals.colwise() - found.mean_goal;
    const double samples = std::max<double>(1, static_cast<double>(goals.cols()) - 1);
    const Eigen::MatrixXd covariance = centred * centred.transpose() / samples;
    const auto [values, vectors] = symmetric_eigen(span.r * covariance * span.r.transpose());
    found.values = values.reverse();
    found.vectors = vectors.rowwise().reverse();
    found.noise = noise_mm * noise_mm * (span.r.transpose() * found.vectors).colwise().squaredNorm();
    return found;
}

std::vector<Eigen::Index> above_noise(const Spectrum& spectrum) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < spectrum.values.size(); ++i) {
        const double round_off = 1e-12 * spectrum.values[0];
        if (spectrum.values[i] > std::max(spectrum.noise[i], round_off)) kept.push_back(i);
    }
    return kept;
}

Eigen::MatrixXd goals_of(const LipBody& body, const Eigen::MatrixXd& frames) {
    if (frames.cols() == 0 || frames.rows() != LipMesh::kMarkedCoordinates || !frames.allFinite())
        throw std::invalid_argument("learn_lips: wants frames of sixteen finite points");
    return frames.colwise() - marked_of(as_column(body.mesh.nodes));
}

// Left and right often tie up to round-off: the first of the largest entries decides.
double sign_of(const Eigen::VectorXd& mode) {
    const double largest = mode.cwiseAbs().maxCoeff();
    const auto first = std::ranges::find_if(mode, [&](double e) { return std::abs(e) > 0.999999 * largest; });
    return *first < 0 ? -1 : 1;
}

// Variance per coordinate of the marked points that the modes carry.
double carried_at_points(const LipModel& model) {
    double sum = 0;
    for (Eigen::Index i = 0; i < model.modes.cols(); ++i)
        sum += model.variance[i] * marked_of(model.modes.col(i)).squaredNorm();
    return sum / LipMesh::kMarkedCoordinates;
}

}  // namespace

LipModel learn_lips(const LipBody& body, const Eigen::MatrixXd& frames, const LipTraining& training) {
    const Eigen::MatrixXd goals = goals_of(body, frames);
    const ThinQr span = thin_qr(body.spread);
    const Spectrum spectrum = spectrum_of(span, goals, training.noise_mm);
    std::vector<Eigen::Index> kept = above_noise(spectrum);
    if (kept.empty()) throw std::runtime_error("learn_lips: nothing moves above the noise");
    if (training.modes < static_cast<int>(kept.size())) kept.resize(std::max(1, training.modes));

    LipModel model;
    model.rest = body.mesh.nodes;
    model.mean = body.spread * spectrum.mean_goal;
    model.modes = span.q * spectrum.vectors(Eigen::all, kept);
    for (Eigen::Index i = 0; i < model.modes.cols(); ++i) model.modes.col(i) *= sign_of(model.modes.col(i));
    model.variance = spectrum.values(kept);
    model.total_variance = spectrum.values.sum();
    model.noise_mm = training.noise_mm;
    model.frames = static_cast<int>(frames.cols());
    const double at_points = (goals.colwise() - spectrum.mean_goal).squaredNorm() /
                             std::max<double>(1, static_cast<double>(goals.cols()) - 1) / goals.rows();
    model.left_over = std::max(0.0, at_points - carried_at_points(model));
    return model;
}

int carried_modes(const LipBody& body, const Eigen::MatrixXd& frames, double noise_mm) {
    return static_cast<int>(
        above_noise(spectrum_of(thin_qr(body.spread), goals_of(body, frames), noise_mm)).size());
}

Eigen::MatrixXd frames_like(const LipModel& model) {
    const Eigen::Index modes = model.modes.cols(),
                       times = std::max<Eigen::Index>(1, model.frames / (2 * modes));
    const MarkedPoints mean = marked_of(as_column(model.rest) + model.mean);
    Eigen::MatrixXd frames(mean.size(), 2 * modes * times);
    for (Eigen::Index i = 0; i < modes; ++i) {
        const MarkedPoints far =
            std::sqrt(static_cast<double>(modes) * model.variance[i]) * marked_of(model.modes.col(i));
        frames.middleCols(2 * i * times, times) = (mean + far).replicate(1, times);
        frames.middleCols((2 * i + 1) * times, times) = (mean - far).replicate(1, times);
    }
    return frames;
}

LipModel with_modes(const LipModel& model, int modes) {
    LipModel fewer = model;
    const Eigen::Index kept = std::clamp<Eigen::Index>(modes, 1, model.modes.cols());
    fewer.modes = model.modes.leftCols(kept);
    fewer.variance = model.variance.head(kept);
    fewer.left_over += carried_at_points(model) - carried_at_points(fewer);
    return fewer;
}

Eigen::VectorXd lip_shape(const LipModel& model, const Eigen::VectorXd& p) {
    return as_column(model.rest) + model.mean + model.modes * p;
}

Eigen::VectorXd lip_modes_of(const LipModel& model, const Eigen::VectorXd& shape) {
    return model.modes.transpose() * (shape - as_column(model.rest) - model.mean);
}

double log_prior(const LipModel& model, const Eigen::VectorXd& p) {
    const double constant = -0.5 * (model.variance.array() * 2 * std::numbers::pi).log().sum();
    return constant - 0.5 * (p.array().square() / model.variance.array()).sum();
}

Eigen::VectorXd log_prior_gradient(const LipModel& model, const Eigen::VectorXd& p) {
    return -p.cwiseQuotient(model.variance);
}

Eigen::VectorXd learned_displacement(const LipModel& model, const Eigen::VectorXd& forces) {
    return model.modes * (model.variance.cwiseSqrt().asDiagonal() * (model.modes.transpose() * forces));
}

}  // namespace viaface
