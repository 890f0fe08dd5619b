#include "viapoints/stream_search.hpp"

#include <algorithm>
#include <type_traits>

#include "viapoints/stream_descent.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNear = 0.1;  // excess at which pairs are worth a try

// Puts via points where the bound is exceeded and there is room, until it holds or there is no more room.
StreamDescent repaired(const SearchProblem& problem, std::vector<int> ticks, const ViaValues& first) {
    for (;;) {
        StreamDescent search(problem, ticks, fitted(problem, ticks, first));
        search.settle(0, ticks.size(), kSoftPenalty, 12);
        if (!search.within()) search.settle(0, ticks.size(), kHardPenalty, 12);
        search.unblock(0, ticks.size(), 4);
        search.refresh();
        if (search.within()) return search;
        std::vector<int> more = ticks;
        for (std::size_t i = 0; i + 1 < ticks.size(); ++i) {
            bool bad = false;
            for (std::size_t f = 0; f < problem.tick.size(); ++f) {
                const double t = problem.tick[f];
                bad |= t >= ticks[i] && t <= ticks[i + 1] && search.error(f) > kBoundLimit;
            }
            if (bad && ticks[i + 1] - ticks[i] > 1) more.push_back((ticks[i] + ticks[i + 1]) / 2);
        }
        if (more.size() == ticks.size()) return search;
        std::sort(more.begin(), more.end());
        ticks = more;
    }
}

// The search with other via times around via point j, settled there; taken when it costs less.
bool try_times(const SearchProblem& problem, StreamDescent& search, std::vector<int> ticks,
               std::vector<ViaValues> values, std::size_t j) {
    const SearchWindow w = window_around(ticks, j, problem.first_fixed);
    const SearchProblem part = part_of(problem, ticks, w);
    const auto cut = [&](const auto& rows) {
        return std::decay_t<decltype(rows)>(rows.begin() + static_cast<std::ptrdiff_t>(w.first),
                                            rows.begin() + static_cast<std::ptrdiff_t>(w.last));
    };
    const std::size_t begin = w.begin - w.first, end = w.end - w.first;
    std::vector<int> own_ticks = cut(ticks);
    std::vector<ViaValues> own_values = cut(values);
    if (part.tick.empty()) return false;
    fit_between(part, own_ticks, own_values, begin, end);
    StreamDescent other(part, std::move(own_ticks), std::move(own_values));
    other.settle(begin, end, kSoftPenalty, 4);
    if (!other.within() && other.excess() < 1.0) other.settle(begin, end, kHardPenalty, 4);
    if (!other.within() && other.excess() < kNear) other.unblock(begin, end, 2);
    if (!other.within()) return false;
    const std::size_t touched = std::min(w.end + 2, ticks.size()), behind = ticks.size() - touched;
    if (other.bits(begin, touched - w.first) >= search.bits(w.begin, search.ticks().size() - behind) - 1e-6)
        return false;
    std::copy(other.values().begin() + static_cast<std::ptrdiff_t>(begin),
              other.values().begin() + static_cast<std::ptrdiff_t>(end),
              values.begin() + static_cast<std::ptrdiff_t>(w.begin));
    search = StreamDescent(problem, std::move(ticks), std::move(values));
    return true;
}

// Each via point but those of the ends: taken out where that costs less.
void thin_out(const SearchProblem& problem, StreamDescent& search) {
    for (std::size_t j = inner_begin(search.ticks()); j < inner_end(search.ticks());) {
        std::vector<int> ticks = search.ticks();
        std::vector<ViaValues> values = search.values();
        ticks.erase(ticks.begin() + static_cast<std::ptrdiff_t>(j));
        values.erase(values.begin() + static_cast<std::ptrdiff_t>(j));
        const bool allowed = ticks[j] - ticks[j - 1] <= kMostGapTicks;
        if (!allowed || !try_times(problem, search, std::move(ticks), std::move(values), j)) ++j;
    }
}

// Each via point but those of the ends: moved by a tick where that costs less.
void shift_times(const SearchProblem& problem, StreamDescent& search) {
    for (std::size_t j = inner_begin(search.ticks()); j < inner_end(search.ticks()); ++j) {
        for (const int by : {-1, 1}) {
            std::vector<int> ticks = search.ticks();
            ticks[j] += by;
            if (ticks[j] <= ticks[j - 1] || ticks[j] >= ticks[j + 1]) continue;
            if (try_times(problem, search, std::move(ticks), search.values(), j)) break;
        }
    }
}

void polish(StreamDescent& search) {
    const std::size_t all = search.ticks().size();
    search.settle(0, all, kSoftPenalty, 6);
    search.sweep_pairs(0, all, kHardPenalty);
    search.settle(0, all, kHardPenalty, 6);
    search.refresh();
}

}  // namespace

QuantisedSegment search_segment(const SegmentTarget& target, const Eigen::MatrixXd& modes,
                                const StreamStatistics& statistics, std::vector<int> ticks,
                                const ViaValues& first, const SearchOptions& options) {
    const StreamCost cost(statistics);
    const SearchProblem problem = problem_of(target, modes, cost, options, !first.empty());
    if (hopeless(problem, ticks)) return {ticks, fitted(problem, ticks, first)};
    StreamDescent search = repaired(problem, std::move(ticks), first);
    for (int round = 0; round < options.rounds && search.within(); ++round) {
        const double before = search.bits();
        thin_out(problem, search);
        shift_times(problem, search);
        polish(search);
        if (search.bits() > before - 1) break;
    }
    return {search.ticks(), search.values()};
}

RowMatrix components_at(const QuantisedSegment& segment, double step_mm, const std::vector<double>& ticks) {
    RowMatrix q(static_cast<Index>(segment.values.size()), static_cast<Index>(segment.values.front().size()));
    for (Index j = 0; j < q.rows(); ++j)
        for (Index k = 0; k < q.cols(); ++k)
            q(j, k) = step_mm * segment.values[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
    return control_weights(segment.tick, ticks) * q;
}

}  // namespace viaface
