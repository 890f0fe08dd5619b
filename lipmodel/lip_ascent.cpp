#include "lipmodel/lip_ascent.hpp"

#include <optional>

namespace viaface {
namespace {

struct Step {
    Eigen::VectorXd theta;
    double value;
};

std::optional<Step> step_up(const LipPosterior& posterior, const Eigen::VectorXd& theta, double value,
                            int halvings) {
    const Eigen::VectorXd direction = posterior.ascent(theta);
    double beta = 1;
    for (int i = 0; i <= halvings; ++i, beta /= 2) {
        const Eigen::VectorXd tried = theta + beta * direction;
        const double reached = posterior.value(tried);
        if (reached > value) return Step{tried, reached};
    }
    return std::nullopt;
}

}  // namespace

LipFit climb(const LipPosterior& posterior, const Eigen::VectorXd& start, const AscentOptions& options) {
    LipFit fit{.theta = start, .log_posterior = posterior.value(start)};
    fit.climbed.push_back(fit.log_posterior);
    while (fit.iterations < options.iterations && !fit.ended) {
        const auto step = step_up(posterior, fit.theta, fit.log_posterior, options.halvings);
        if (!step) {
            fit.ended = true;
            break;
        }
        fit.ended = step->value - fit.log_posterior < options.least_gain;
        fit.theta = step->theta;
        fit.log_posterior = step->value;
        fit.climbed.push_back(step->value);
        ++fit.iterations;
    }
    return fit;
}

}  // namespace viaface
