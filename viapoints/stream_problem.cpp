#include "viapoints/stream_problem.hpp"

#include <algorithm>
#include <cmath>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kReach = 3;  // via points to either side that settle after a change of times
constexpr std::size_t kMargin = 9;
constexpr float kHopeless = 2;    // bounds
constexpr double kSteady = 1e-3;  // of the normal equations' diagonal, in samples

std::int32_t rounded(double value) {
    return static_cast<std::int32_t>(
        std::clamp(std::round(value), -1.0 * kLargestValue, 1.0 * kLargestValue));
}

Eigen::MatrixXd ridge_solution(const RowMatrix& response, const RowMatrix& wanted, double steady) {
    Eigen::MatrixXd normal = response.transpose() * response;
    normal.diagonal().array() += steady;
    return solve_positive(normal, Eigen::MatrixXd(response.transpose() * wanted));
}

}  // namespace

SearchProblem problem_of(const SegmentTarget& target, const Eigen::MatrixXd& modes, const StreamCost& cost,
                         const SearchOptions& options, bool first_fixed) {
    const Index p = modes.rows() / 3;
    SearchProblem problem{target.tick,
                          Eigen::MatrixXf(modes.rows(), modes.cols()),
                          Eigen::MatrixXf(modes.rows(), target.points.rows()),
                          {},
                          cost,
                          options.step_mm,
                          first_fixed};
    for (Index i = 0; i < p; ++i) {
        for (Index a = 0; a < 3; ++a) {
            problem.mode_rows.row(a * p + i) =
                (modes.row(3 * i + a) * (options.step_mm / options.bound_mm)).cast<float>();
            problem.wanted.row(a * p + i) =
                (target.points.col(3 * i + a).transpose() / options.bound_mm).cast<float>();
        }
    }
    problem.components = least_squares(modes, Eigen::MatrixXd(target.points.transpose())).transpose();
    return problem;
}

SearchWindow window_around(const std::vector<int>& ticks, std::size_t j, bool first_fixed) {
    SearchWindow w{0, ticks.size(), std::max<std::size_t>(j > kReach ? j - kReach : 0, first_fixed),
                   std::min(j + kReach + 1, ticks.size())};
    if (w.begin > kMargin + 3) w.first = w.begin - kMargin;
    if (w.end + kMargin + 3 < ticks.size()) w.last = w.end + kMargin;
    return w;
}

SearchProblem part_of(const SearchProblem& problem, const std::vector<int>& ticks, const SearchWindow& w) {
    const double from = ticks[w.begin > 3 ? w.begin - 3 : 0],
                 to = ticks[std::min(w.end + 2, ticks.size() - 1)];
    const auto begin = std::lower_bound(problem.tick.begin(), problem.tick.end(), from);
    const auto end = std::upper_bound(begin, problem.tick.end(), to);
    const Index at = begin - problem.tick.begin(), n = end - begin;
    return {std::vector<double>(begin, end),      problem.mode_rows, problem.wanted.middleCols(at, n),
            problem.components.middleRows(at, n), problem.cost,      problem.step,
            problem.first_fixed && w.first == 0};
}

std::vector<ViaValues> fitted(const SearchProblem& problem, const std::vector<int>& ticks,
                              const ViaValues& first) {
    std::vector<ViaValues> values(ticks.size(),
                                  ViaValues(static_cast<std::size_t>(problem.components.cols())));
    if (!first.empty()) values[0] = first;
    if (first.empty() || ticks.size() > 1)
        fit_between(problem, ticks, values, first.empty() ? 0 : 1, ticks.size());
    return values;
}

void fit_between(const SearchProblem& problem, const std::vector<int>& ticks, std::vector<ViaValues>& values,
                 std::size_t begin, std::size_t end) {
    const RowMatrix response = control_weights(ticks, problem.tick);
    Index from = 0, to = response.rows();
    const auto b = static_cast<Index>(begin), n = static_cast<Index>(end - begin);
    const auto idle = [&](Index f) { return !(response.block(f, b, 1, n).array() > 0).any(); };
    while (from < to && idle(from)) ++from;
    while (to > from && idle(to - 1)) --to;
    RowMatrix others = RowMatrix::Zero(response.cols(), problem.components.cols());
    for (Index j = 0; j < others.rows(); ++j) {
        if (j >= b && j < b + n) continue;
        for (Index k = 0; k < others.cols(); ++k)
            others(j, k) = problem.step * values[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
    }
    const RowMatrix rest =
        problem.components.middleRows(from, to - from) - response.middleRows(from, to - from) * others;
    const Eigen::MatrixXd x = ridge_solution(response.block(from, b, to - from, n), rest, kSteady);
    for (Index j = 0; j < n; ++j)
        for (Index k = 0; k < x.cols(); ++k)
            values[begin + static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] =
                rounded(x(j, k) / problem.step);
}

bool hopeless(const SearchProblem& problem, const std::vector<int>& ticks) {
    std::vector<int> all(ticks.begin(), ticks.begin() + static_cast<std::ptrdiff_t>(inner_begin(ticks)));
    for (int t = ticks.front() + 1; t < ticks.back(); ++t) all.push_back(t);
    all.insert(all.end(), ticks.begin() + static_cast<std::ptrdiff_t>(inner_end(ticks)), ticks.end());
    const RowMatrix response = control_weights(all, problem.tick);
    const RowMatrix drawn = response * ridge_solution(response, problem.components, 1e-6);
    const Eigen::MatrixXf off =
        problem.mode_rows * (drawn / problem.step).transpose().cast<float>() - problem.wanted;
    return off.cwiseAbs().maxCoeff() > kHopeless;
}

std::size_t inner_begin(const std::vector<int>& ticks) { return moves_first(ticks) ? 3 : 1; }

std::size_t inner_end(const std::vector<int>& ticks) { return ticks.size() - (moves_last(ticks) ? 3 : 1); }

}  // namespace viaface
