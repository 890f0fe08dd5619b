#include "viapoints/stream_search.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "viapoints/stream_descent.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNear = 0.1;       // excess at which pairs are worth a try
constexpr double kLeastWon = 1e-6;  // bits

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
        if (more.size() == ticks.size()) {
            search.insist(0, ticks.size(), 12);
            return search;
        }
        std::sort(more.begin(), more.end());
        ticks = more;
    }
}

// A search within its bound, and which of its via points are worth another try: those about which something
// has changed since the last one.
class TimeSearch {
  public:
    TimeSearch(const SearchProblem& problem, StreamDescent& search)
        : problem_(problem), search_(search), rows_(search.ticks().size()) {}

    void thin_out();
    void shift_times();
    void polish();

  private:
    enum Attempt { kThinning, kShifting };
    struct Row {
        int changed = 0;
        std::array<int, 2> tried = {-1, -1};  // by attempt
    };

    bool worth(std::size_t j, Attempt attempt);
    bool took(std::vector<int> ticks, std::vector<ViaValues> values, std::size_t j, bool fit_anew = true);
    bool took_without(std::size_t j);

    const SearchProblem& problem_;
    StreamDescent& search_;
    std::vector<Row> rows_;
    int now_ = 0;
};

bool TimeSearch::worth(std::size_t j, Attempt attempt) {
    constexpr std::size_t kNearby = 8;
    int& tried = rows_[j].tried[attempt];
    bool changed = false;
    for (std::size_t n = j > kNearby ? j - kNearby : 0; n < std::min(j + kNearby + 1, rows_.size()); ++n)
        changed |= rows_[n].changed > tried;
    tried = now_++;
    return changed;
}

// Other via times around via point j, settled there from values fitted anew or as they are; taken when they
// cost less.
bool TimeSearch::took(std::vector<int> ticks, std::vector<ViaValues> values, std::size_t j, bool fit_anew) {
    const SearchWindow w = window_around(ticks, j, problem_.first_fixed);
    const SearchProblem part = part_of(problem_, ticks, w);
    const auto cut = [&](const auto& rows) {
        return std::decay_t<decltype(rows)>(rows.begin() + static_cast<std::ptrdiff_t>(w.first),
                                            rows.begin() + static_cast<std::ptrdiff_t>(w.last));
    };
    const std::size_t begin = w.begin - w.first, end = w.end - w.first;
    std::vector<int> own_ticks = cut(ticks);
    std::vector<ViaValues> own_values = cut(values);
    if (part.tick.empty()) return false;
    if (fit_anew) fit_between(part, own_ticks, own_values, begin, end);
    StreamDescent other(part, std::move(own_ticks), std::move(own_values));
    const std::size_t touched = std::min(w.end + 2, ticks.size()), behind = ticks.size() - touched;
    const double most = search_.bits(w.begin, search_.ticks().size() - behind) - kLeastWon;
    const auto bits = [&] { return other.bits(begin, touched - w.first); };
    other.settle(begin, end, kSoftPenalty, 4);
    if (bits() + kSoftPenalty * other.excess() >= most) return false;
    if (!other.within() && other.excess() < 1.0) other.settle(begin, end, kHardPenalty, 4);
    if (!other.within() && other.excess() < kNear) other.unblock(begin, end, 2);
    if (!other.within() || bits() >= most) return false;
    std::copy(other.values().begin() + static_cast<std::ptrdiff_t>(begin),
              other.values().begin() + static_cast<std::ptrdiff_t>(end),
              values.begin() + static_cast<std::ptrdiff_t>(w.begin));
    if (ticks.size() < rows_.size()) rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(j));
    for (std::size_t n = w.begin; n < w.end; ++n) rows_[n].changed = now_;
    search_ = StreamDescent(problem_, std::move(ticks), std::move(values));
    return true;
}

// Via point j taken out where that costs less.
bool TimeSearch::took_without(std::size_t j) {
    std::vector<int> ticks = search_.ticks();
    std::vector<ViaValues> values = search_.values();
    if (ticks[j + 1] - ticks[j - 1] > kMostGapTicks) return false;
    const bool still = values[j - 1] == values[j] && values[j] == values[j + 1];
    ticks.erase(ticks.begin() + static_cast<std::ptrdiff_t>(j));
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(j));
    return took(std::move(ticks), std::move(values), j, !still);
}

// Each via point but those of the ends: taken out where that costs less.
void TimeSearch::thin_out() {
    for (std::size_t j = inner_begin(search_.ticks()); j < inner_end(search_.ticks());) {
        if (!worth(j, kThinning) || !took_without(j)) ++j;
    }
}

// Each via point but those of the ends: moved by a tick where that costs less.
void TimeSearch::shift_times() {
    for (std::size_t j = inner_begin(search_.ticks()); j < inner_end(search_.ticks()); ++j) {
        if (!worth(j, kShifting)) continue;
        for (const int by : {-1, 1}) {
            std::vector<int> ticks = search_.ticks();
            ticks[j] += by;
            if (ticks[j] <= ticks[j - 1] || ticks[j] >= ticks[j + 1]) continue;
            if (took(std::move(ticks), search_.values(), j)) break;
        }
    }
}

void TimeSearch::polish() {
    const StreamDescent kept = search_;
    const std::size_t all = kept.values().size();
    search_.settle(0, all, kSoftPenalty, 6);
    search_.sweep_pairs(0, all, kHardPenalty);
    search_.settle(0, all, kHardPenalty, 6);
    search_.refresh();
    if (!search_.within() || search_.bits() > kept.bits()) search_ = kept;
    for (std::size_t n = 0; n < all; ++n)
        if (search_.values()[n] != kept.values()[n]) rows_[n].changed = now_;
}

}  // namespace

QuantisedSegment search_segment(const SegmentTarget& target, const Eigen::MatrixXd& modes,
                                const StreamStatistics& statistics, std::vector<int> ticks,
                                const ViaValues& first, const SearchOptions& options) {
    const StreamCost cost(statistics);
    const SearchProblem problem = problem_of(target, modes, cost, options, !first.empty());
    if (hopeless(problem, ticks)) return {ticks, fitted(problem, ticks, first)};
    StreamDescent search = repaired(problem, std::move(ticks), first);
    TimeSearch times(problem, search);
    for (int round = 0; round < options.rounds && search.within(); ++round) {
        const double before = search.bits();
        times.thin_out();
        times.shift_times();
        times.polish();
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
