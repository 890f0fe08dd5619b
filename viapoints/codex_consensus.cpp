#include "viapoints/codex_consensus.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/decompositions.hpp"
#include "viapoints/lip_rows.hpp"

namespace viaface {
namespace {

constexpr double kLeastScatter = 1e-6;  // mm: two units of one context share alike

bool leads(PhoneId left) { return left == kPause; }

std::vector<std::pair<double, std::int32_t>> by_unlikeness(const Codex& codex, PhoneId centre,
                                                           const PhoneContext& asked,
                                                           std::int32_t without_recitation) {
    const auto of_centre = [&](const TriphoneUnit& unit) { return unit.centre < centre; };
    const auto first = std::partition_point(codex.units.begin(), codex.units.end(), of_centre);
    std::vector<std::pair<double, std::int32_t>> found;
    for (auto unit = first; unit != codex.units.end() && unit->centre == centre; ++unit) {
        if (unit->recitation == without_recitation) continue;
        if (centre == kPause && leads(unit->left) != leads(asked.left)) continue;
        found.emplace_back(unlikeness(context_of(codex, *unit), asked),
                           static_cast<std::int32_t>(unit - codex.units.begin()));
    }
    std::sort(found.begin(), found.end());
    found.resize(std::min(found.size(), kMostAlike));
    return found;
}

const TriphoneUnit& unit_at(const Codex& codex, std::int32_t unit) {
    return codex.units[static_cast<std::size_t>(unit)];
}

// s, in its recitation.
double begin_of(const Codex& codex, const TriphoneUnit& unit) {
    double begin = 0;
    for (std::int32_t place = 0; place < unit.place; ++place)
        begin += codex.recitations[static_cast<std::size_t>(unit.recitation)][static_cast<std::size_t>(place)]
                     .duration_s;
    return begin;
}

// Where in a unit's phone the instant is, relative to it.
double instant_in(const TriphoneUnit& unit, const RecitedPhone& body, const PhoneInstants& instants,
                  double at) {
    if (unit.centre == kPause) {
        const double share = instants.duration_s / body.duration_s;
        return leads(unit.left) ? 1 - std::min((1 - at) * share, 1.0) : std::min(at * share, 1.0);
    }
    if (nucleus_rank(unit.centre) == ViaRank::kNucleus) return at;
    const double nucleus = body.via[static_cast<std::size_t>(body.nucleus)];
    if (at > instants.nucleus) return 1 - (1 - at) * (1 - nucleus) / (1 - instants.nucleus);
    return instants.nucleus > 0 ? at * nucleus / instants.nucleus : nucleus;
}

}  // namespace

AlikeUnits alike_units(const Codex& codex, PhoneId centre, const PhoneContext& asked,
                       std::int32_t without_recitation) {
    AlikeUnits alike;
    const auto found = by_unlikeness(codex, centre, asked, without_recitation);
    const std::ptrdiff_t n = std::ssize(found);
    alike.to_asked.resize(n);
    alike.between.setZero(n, n);
    std::vector<PhoneContext> contexts;
    for (const auto& [unlike, unit] : found) {
        const std::ptrdiff_t i = std::ssize(alike.units);
        alike.to_asked[i] = unlike;
        contexts.push_back(context_of(codex, unit_at(codex, unit)));
        for (std::ptrdiff_t j = 0; j < i; ++j) {
            alike.between(i, j) = alike.between(j, i) =
                unlikeness(contexts.back(), contexts[static_cast<std::size_t>(j)]);
        }
        alike.units.push_back(unit);
    }
    return alike;
}

// With C = c - gamma, c over all of gamma: w = C^-1 (c - gamma(asked) + l), l such that the sum is 1.
Eigen::VectorXd kriging_weights(const AlikeUnits& alike, double scatter_mm) {
    const Eigen::Index n = alike.to_asked.size();
    if (n == 0) return {};
    const double s = std::max(scatter_mm, kLeastScatter);
    const double c = s + std::max(alike.between.maxCoeff(), alike.to_asked.maxCoeff()) + 1;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(n, n, c - s) - alike.between;
    covariance.diagonal().array() += s;
    Eigen::MatrixXd sides(n, 2);
    sides.col(0) = (c - s) - alike.to_asked.array();
    sides.col(1).setOnes();
    const Eigen::MatrixXd solved = solve_positive(covariance, sides);
    return solved.col(0) + solved.col(1) * ((1 - solved.col(0).sum()) / solved.col(1).sum());
}

RowMatrix agreed_motion(const Codex& codex, const AlikeUnits& alike, const Eigen::VectorXd& weights,
                        const PhoneInstants& instants) {
    if (codex.motions.empty()) throw std::invalid_argument("agreed_motion: a codex without a scatter");
    RowMatrix agreed = RowMatrix::Zero(std::ssize(instants.at), codex.rest.size());
    for (std::size_t i = 0; i < alike.units.size(); ++i) {
        const TriphoneUnit& unit = unit_at(codex, alike.units[i]);
        const RecitedPhone& body = body_of(codex, unit);
        const MinimumJerkSpline& motion = codex.motions[static_cast<std::size_t>(unit.recitation)];
        const double begin = begin_of(codex, unit);
        for (Eigen::Index row = 0; row < agreed.rows(); ++row) {
            const double at = instant_in(unit, body, instants, instants.at[static_cast<std::size_t>(row)]);
            agreed.row(row) +=
                weights[static_cast<Eigen::Index>(i)] * motion.at(begin + at * body.duration_s).transpose();
        }
    }
    return agreed;
}

Eigen::RowVectorXd with_lips_together(const Codex& codex, const Eigen::RowVectorXd& components) {
    const std::optional<LipRows> lips = lip_rows(codex.basis);
    if (!lips) return components;
    const double gap = lips->apart.dot(components - codex.rest.transpose());
    return components - lips->apart * (std::max(gap + kPressedLips, 0.0) / lips->apart.squaredNorm());
}

}  // namespace viaface
