#include "synth/lips/lip_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lipmodel/elements.hpp"
#include "lipmodel/spread.hpp"

namespace viaface {
namespace {

LipFigures figures_of(const LipFrames& frames, const LipTraining& training) {
    const LipBody body = lip_body(resting_lips(frames));
    const LipModel model = learn_lips(body, frames.points, training);
    return {.frames = static_cast<int>(frames.points.cols()),
            .carried = carried_modes(body, frames.points, training.noise_mm),
            .variance = {model.variance.begin(), model.variance.end()},
            .total_variance = model.total_variance,
            .by_modes = cross_validated(body, frames.points, training)};
}

double rms(const Eigen::MatrixXd& m) { return std::sqrt(m.squaredNorm() / static_cast<double>(m.size())); }

}  // namespace

LipReport report_lips(const LipFrames& train, const std::optional<LipFrames>& test, const LipFrames& recited,
                      const LipTraining& training) {
    const LipBody body = lip_body(resting_lips(train));
    LipReport report;
    report.noise_mm = training.noise_mm;
    report.extent_mm = largest_extent(body.mesh.nodes);
    report.trained = figures_of(train, training);
    report.recited = figures_of(recited, training);
    if (test) {
        const LipModel model = learn_lips(body, train.points, training);
        report.tried_frames = static_cast<int>(test->points.cols());
        for (int modes = 1; modes <= model.modes.cols(); ++modes)
            report.tried.push_back(reconstruction_errors(body, with_modes(model, modes), test->points));
    }
    const GroundedBody grounded(assemble(body.mesh.nodes, body.mesh.triangles, body.mesh.stiffness),
                                held_nodes());
    const Eigen::MatrixXd goals = train.points.colwise() - marked_of(as_column(body.mesh.nodes));
    const Eigen::MatrixXd by_force = body.spread * goals;
    report.force_beside_energy_mm = rms(by_force - least_energy_spread(grounded, marked_nodes()) * goals);
    report.moved_mm = rms(by_force);
    return report;
}

double share_of(const LipFigures& figures, std::size_t modes) {
    const auto end =
        figures.variance.begin() + static_cast<std::ptrdiff_t>(std::min(modes, figures.variance.size()));
    return std::accumulate(figures.variance.begin(), end, 0.0) / figures.total_variance;
}

}  // namespace viaface
