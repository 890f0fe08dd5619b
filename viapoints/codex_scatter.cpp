#include <algorithm>
#include <cmath>

#include "viapoints/codex_consensus.hpp"

namespace viaface {
namespace {

constexpr double kNoError = 1e-6;  // mm^2, what rounding leaves
constexpr std::ptrdiff_t kLadder = std::ssize(kScatters);

// Of each recitation, the mean squared error of its phones as the others tell them, for every scatter.
struct Errors {
    Eigen::ArrayXXd sum;        // [recitations x scatters], mm^2 s
    Eigen::ArrayXd duration_s;  // [recitations]
};

PhoneInstants instants_in(const RecitedPhone& phone) {
    constexpr int kInstants = 8;
    PhoneInstants instants{{}, phone.via[static_cast<std::size_t>(phone.nucleus)], phone.duration_s};
    for (int i = 0; i < kInstants; ++i) instants.at.push_back((i + 0.5) / kInstants);
    return instants;
}

void add_unit(const Codex& codex, std::int32_t index, Errors& errors) {
    const TriphoneUnit& unit = codex.units[static_cast<std::size_t>(index)];
    const AlikeUnits others = alike_units(codex, unit.centre, context_of(codex, unit), unit.recitation);
    if (others.units.empty()) return;
    const RecitedPhone& body = body_of(codex, unit);
    const PhoneInstants instants = instants_in(body);
    const AlikeUnits itself{{index}, Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, 1)};
    const RowMatrix recited = agreed_motion(codex, itself, Eigen::VectorXd::Ones(1), instants);
    for (std::ptrdiff_t i = 0; i < kLadder; ++i) {
        const RowMatrix told = agreed_motion(codex, others, kriging_weights(others, kScatters[i]), instants);
        errors.sum(unit.recitation, i) +=
            body.duration_s * (told - recited).squaredNorm() / static_cast<double>(recited.rows());
    }
    errors.duration_s[unit.recitation] += body.duration_s;
}

// The signed rank test [Wilcoxon45], one-sided: whether so much of worse recitations comes by chance once in
// twenty times at most.
bool is_worse(const Eigen::ArrayXd& difference) {
    std::vector<double> apart(difference.begin(), difference.end());
    std::erase_if(apart, [](double d) { return std::abs(d) < kNoError; });
    std::sort(apart.begin(), apart.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    double ranks = 0;
    for (std::size_t i = 0; i < apart.size(); ++i)
        if (apart[i] > 0) ranks += static_cast<double>(i + 1);
    const auto n = static_cast<double>(apart.size());
    const double mean = n * (n + 1) / 4, deviation = std::sqrt(n * (n + 1) * (2 * n + 1) / 24);
    return ranks - 0.5 - mean > 1.645 * deviation;
}

double best_scatter(const Errors& errors) {
    std::vector<Eigen::Index> told;
    for (Eigen::Index r = 0; r < errors.duration_s.size(); ++r)
        if (errors.duration_s[r] > 0) told.push_back(r);
    if (told.empty()) return 0;
    const Eigen::ArrayXXd means =
        errors.sum(told, Eigen::all).colwise() / Eigen::ArrayXd(errors.duration_s(told));
    Eigen::Index best = 0;
    means.colwise().mean().minCoeff(&best);
    for (Eigen::Index i = 0; i < best; ++i)
        if (!is_worse(means.col(i) - means.col(best))) return kScatters[i];
    return kScatters[best];
}

}  // namespace

Codex with_scatter(Codex codex) {
    codex = make_codex(std::move(codex.basis), std::move(codex.rest), std::move(codex.recitations),
                       std::move(codex.provenance), 0.0);
    const auto recitations = std::ssize(codex.recitations);
    Errors errors{Eigen::ArrayXXd::Zero(recitations, kLadder), Eigen::ArrayXd::Zero(recitations)};
    for (std::int32_t i = 0; i < std::ssize(codex.units); ++i) {
        if (codex.units[static_cast<std::size_t>(i)].centre != kPause) add_unit(codex, i, errors);
    }
    codex.scatter_mm = best_scatter(errors);
    return codex;
}

}  // namespace viaface
