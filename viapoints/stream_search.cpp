#include "viapoints/stream_search.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "viapoints/stream_cost.hpp"
#include "viapoints/stream_spline.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using FrameErrors = Eigen::Array<float, Eigen::Dynamic, 1>;
using PointRow = Eigen::Array<float, Eigen::Dynamic, 1>;

constexpr float kLimit = 0.998f;  // of the bound, squared: what rounding of the search may take
constexpr double kPenalty = 60;   // bits per unit of squared error over the bound, at each sample
constexpr double kHard = 1e4;
constexpr double kNear = 0.1;      // excess at which pairs are worth a try
constexpr std::size_t kReach = 4;  // via points to either side that settle after a change of times
constexpr std::size_t kMargin = 9;
constexpr float kHopeless = 2;  // bounds
constexpr float kSmallResponse = 1e-4f;

// The via points that are not of the ends: [inner_begin, inner_end).
std::size_t inner_begin(const std::vector<int>& ticks) { return moves_first(ticks) ? 3 : 1; }
std::size_t inner_end(const std::vector<int>& ticks) { return ticks.size() - (moves_last(ticks) ? 3 : 1); }

// What does not change during the search. Points are kept as all x, all y, all z.
struct Problem {
    std::vector<double> tick;   // of the samples
    Eigen::MatrixXf mode_rows;  // [3 points x k], reordered, times step / bound
    Eigen::MatrixXf wanted;     // [3 points x samples], reordered, / bound
    RowMatrix components;       // [samples x k], mm
    const StreamCost& cost;
    double step;
    bool first_fixed;
    Index points() const { return wanted.rows() / 3; }
};

struct Layout {  // of one set of via times
    std::vector<int> tick;
    Eigen::MatrixXf response;  // [samples x via]
    std::vector<Index> from, to;
};

Layout lay_out(const std::vector<double>& samples, std::vector<int> ticks) {
    Layout layout{std::move(ticks), {}, {}, {}};
    layout.response = control_weights(layout.tick, samples).cast<float>();
    for (Index j = 0; j < layout.response.cols(); ++j) {
        Index from = 0, to = layout.response.rows();
        while (from < to && std::abs(layout.response(from, j)) < kSmallResponse) ++from;
        while (to > from && std::abs(layout.response(to - 1, j)) < kSmallResponse) --to;
        layout.from.push_back(from);
        layout.to.push_back(to);
    }
    return layout;
}

class Search {
  public:
    Search(const Problem& problem, std::vector<int> ticks, std::vector<ViaValues> values)
        : problem_(&problem), layout_(lay_out(problem.tick, std::move(ticks))), values_(std::move(values)) {
        refresh();
    }

    void refresh() {
        Eigen::MatrixXf q(static_cast<Index>(values_.size()), problem_->mode_rows.cols());
        for (Index j = 0; j < q.rows(); ++j)
            for (Index k = 0; k < q.cols(); ++k)
                q(j, k) =
                    static_cast<float>(values_[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)]);
        off_ = problem_->mode_rows * (layout_.response * q).transpose() - problem_->wanted;
        const Index p = problem_->points();
        error_.resize(off_.cols());
        for (Index f = 0; f < off_.cols(); ++f) {
            error_[f] =
                (off_.col(f).segment(0, p).array().square() + off_.col(f).segment(p, p).array().square() +
                 off_.col(f).segment(2 * p, p).array().square())
                    .maxCoeff();
        }
        bits_.resize(values_.size());
        for (std::size_t j = 0; j < values_.size(); ++j) bits_[j] = event_bits(j);
    }

    double bits() const { return bits(0, bits_.size()); }
    double bits(std::size_t begin, std::size_t end) const {
        double sum = 0;
        for (std::size_t j = begin; j < end; ++j) sum += bits_[j];
        return sum;
    }
    double excess() const { return (error_ - kLimit).max(0.0f).cast<double>().sum(); }
    bool within() const { return !(error_ > kLimit).any(); }
    const std::vector<int>& ticks() const { return layout_.tick; }
    const std::vector<ViaValues>& values() const { return values_; }
    const FrameErrors& errors() const { return error_; }

    // One sweep over via points [begin, end); whether anything moved.
    bool sweep(std::size_t begin, std::size_t end, double penalty) {
        bool moved = false;
        for (std::size_t j = std::max<std::size_t>(begin, problem_->first_fixed); j < end; ++j) {
            for (int k = static_cast<int>(problem_->mode_rows.cols()) - 1; k >= 0; --k) {
                for (const int by : {-1, 1}) {
                    while (try_move(j, k, by, penalty)) moved = true;
                }
            }
        }
        return moved;
    }
    void settle(std::size_t begin, std::size_t end, double penalty, int most) {
        for (int i = 0; i < most && sweep(begin, end, penalty); ++i) {
        }
    }

    // Pairs where the bound is exceeded, until it is not or nothing helps.
    void unblock(std::size_t begin, std::size_t end, int most) {
        for (int i = 0; i < most && !within(); ++i) {
            bool moved = false;
            for (std::size_t j = begin; j < end; ++j) {
                if (touches_excess(j)) moved |= sweep_pairs(j, j + 1, kHard);
            }
            settle(begin, end, kHard, 4);
            if (!moved) return;
        }
    }
    bool touches_excess(std::size_t j) const {
        for (Index f = layout_.from[j]; f < layout_.to[j]; ++f) {
            if (error_[f] > kLimit && std::abs(layout_.response(f, static_cast<Index>(j))) > 0.05f)
                return true;
        }
        return false;
    }

    // Two neighbours in time, or two components, at once.
    bool sweep_pairs(std::size_t begin, std::size_t end, double penalty) {
        bool moved = false;
        const int n = static_cast<int>(problem_->mode_rows.cols());
        for (std::size_t j = std::max<std::size_t>(begin, problem_->first_fixed); j < end; ++j) {
            for (int k = 0; k < n; ++k) {
                for (const int a : {-1, 1}) {
                    for (const int b : {-1, 1}) {
                        if (j + 1 < values_.size()) moved |= try_pair(j, k, a, j + 1, k, b, penalty);
                        for (int l = k + 1; l < n; ++l) moved |= try_pair(j, k, a, j, l, b, penalty);
                    }
                }
            }
        }
        return moved;
    }

  private:
    double event_bits(std::size_t j) const { return problem_->cost.event(layout_.tick, values_, j); }
    double bits_around(std::size_t j, std::size_t last) const {
        double sum = 0;
        for (std::size_t i = j; i <= last; ++i) sum += event_bits(i);
        return sum;
    }
    double known_bits(std::size_t j, std::size_t last) const {
        double sum = 0;
        for (std::size_t i = j; i <= last; ++i) sum += bits_[i];
        return sum;
    }

    // The change of penalty * excess when component k of via point j moves; stops once over `most`.
    double excess_change(std::size_t j, int k, int by, double most, double penalty,
                         FrameErrors& fresh) const {
        const Index p = problem_->points();
        const auto mode = problem_->mode_rows.col(k).array();
        double change = 0;
        const Index from = layout_.from[j], to = layout_.to[j];
        // the excess now is what may at most be won
        double left = 0;
        for (Index f = from; f < to; ++f) left += std::max(0.0f, error_[f] - kLimit);
        fresh.resize(to - from);
        for (Index f = from; f < to; ++f) {
            const float a = static_cast<float>(by) * layout_.response(f, static_cast<Index>(j));
            const auto off = off_.col(f).array();
            const float e = ((off.segment(0, p) + a * mode.segment(0, p)).square() +
                             (off.segment(p, p) + a * mode.segment(p, p)).square() +
                             (off.segment(2 * p, p) + a * mode.segment(2 * p, p)).square())
                                .maxCoeff();
            fresh[f - from] = e;
            const double was = std::max(0.0f, error_[f] - kLimit), is = std::max(0.0f, e - kLimit);
            change += penalty * (is - was);
            left -= was;
            if (change - penalty * left > most) return change - penalty * left;
        }
        return change;
    }

    bool try_move(std::size_t j, int k, int by, double penalty) {
        const std::size_t last = std::min(j + 2, values_.size() - 1);
        const double before = known_bits(j, last);
        std::int32_t& value = values_[j][static_cast<std::size_t>(k)];
        value += by;
        const double bits = bits_around(j, last) - before;
        const double needed = -bits - 1e-6;
        const bool good =
            std::abs(value) <= kLargestValue && excess_change(j, k, by, needed, penalty, fresh_) < needed;
        if (!good) {
            value -= by;
            return false;
        }
        apply(j, k, by);
        for (std::size_t i = j; i <= last; ++i) bits_[i] = event_bits(i);
        return true;
    }

    void apply(std::size_t j, int k, int by) {
        const Index from = layout_.from[j], n = layout_.to[j] - from;
        off_.middleCols(from, n).noalias() +=
            problem_->mode_rows.col(k) *
            (static_cast<float>(by) * layout_.response.col(static_cast<Index>(j)).segment(from, n))
                .transpose();
        error_.segment(from, n) = fresh_.head(n);
    }

    bool try_pair(std::size_t j, int k, int a, std::size_t i, int l, int b, double penalty) {
        const std::size_t last = std::min(i + 2, values_.size() - 1);
        const double before = known_bits(j, last);
        values_[j][static_cast<std::size_t>(k)] += a;
        values_[i][static_cast<std::size_t>(l)] += b;
        const double bits = bits_around(j, last) - before;
        const double needed = -bits - 1e-6;
        if (needed > 0 || excess() > 0) {
            const double one = excess_change(j, k, a, 1e9, penalty, fresh_);
            const FrameErrors kept = error_;
            apply(j, k, a);
            const double two = excess_change(i, l, b, needed - one, penalty, fresh_);
            if (one + two < needed) {
                apply(i, l, b);
                for (std::size_t e = j; e <= last; ++e) bits_[e] = event_bits(e);
                return true;
            }
            apply_back(j, k, a, kept);
        }
        values_[j][static_cast<std::size_t>(k)] -= a;
        values_[i][static_cast<std::size_t>(l)] -= b;
        return false;
    }
    void apply_back(std::size_t j, int k, int by, const FrameErrors& kept) {
        const Index from = layout_.from[j], n = layout_.to[j] - from;
        fresh_ = kept.segment(from, n);
        apply(j, k, -by);
    }

    const Problem* problem_;
    Layout layout_;
    std::vector<ViaValues> values_;
    Eigen::MatrixXf off_;  // [3 points x samples], drawn minus wanted, / bound
    FrameErrors error_;    // the largest squared distance of each sample / bound^2
    std::vector<double> bits_;
    FrameErrors fresh_;
};

std::vector<ViaValues> fitted(const Problem& problem, const std::vector<int>& ticks, const ViaValues& first) {
    const RowMatrix response = control_weights(ticks, problem.tick);
    Eigen::MatrixXd normal = response.transpose() * response;
    normal.diagonal().array() += 1e-3;
    const Eigen::MatrixXd x = normal.ldlt().solve(response.transpose() * problem.components) / problem.step;
    std::vector<ViaValues> values(ticks.size(), ViaValues(static_cast<std::size_t>(x.cols())));
    for (Index j = 0; j < x.rows(); ++j)
        for (Index k = 0; k < x.cols(); ++k)
            values[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] = static_cast<std::int32_t>(
                std::clamp(std::round(x(j, k)), -1.0 * kLargestValue, 1.0 * kLargestValue));
    if (!first.empty()) values[0] = first;
    return values;
}

// Values of via points [begin, end) fitted again by least squares, the others as they are.
void fit_between(const Problem& problem, const std::vector<int>& ticks, std::vector<ViaValues>& values,
                 std::size_t begin, std::size_t end) {
    const RowMatrix response = control_weights(ticks, problem.tick);
    Index from = 0, to = response.rows();
    const auto b = static_cast<Index>(begin), n = static_cast<Index>(end - begin);
    const auto idle = [&](Index f) { return !(response.block(f, b, 1, n).array() > 0).any(); };
    while (from < to && idle(from)) ++from;
    while (to > from && idle(to - 1)) --to;
    RowMatrix q(response.cols(), problem.components.cols());
    for (Index j = 0; j < q.rows(); ++j)
        for (Index k = 0; k < q.cols(); ++k)
            q(j, k) = j >= b && j < b + n
                          ? 0
                          : problem.step * values[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
    const RowMatrix rest =
        problem.components.middleRows(from, to - from) - response.middleRows(from, to - from) * q;
    const RowMatrix own = response.block(from, b, to - from, n);
    Eigen::MatrixXd normal = own.transpose() * own;
    normal.diagonal().array() += 1e-3;
    const Eigen::MatrixXd x = normal.ldlt().solve(own.transpose() * rest) / problem.step;
    for (Index j = 0; j < n; ++j)
        for (Index k = 0; k < x.cols(); ++k)
            values[begin + static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] =
                static_cast<std::int32_t>(
                    std::clamp(std::round(x(j, k)), -1.0 * kLargestValue, 1.0 * kLargestValue));
}

// Puts via points where the bound is exceeded and there is room, until it holds or there is no more room.
Search repaired(const Problem& problem, std::vector<int> ticks, const ViaValues& first) {
    for (;;) {
        Search search(problem, ticks, fitted(problem, ticks, first));
        search.settle(0, ticks.size(), kPenalty, 12);
        if (!search.within()) search.settle(0, ticks.size(), kHard, 12);
        search.unblock(0, ticks.size(), 4);
        search.refresh();
        if (search.within()) return search;
        std::vector<int> more = ticks;
        for (std::size_t i = 0; i + 1 < ticks.size(); ++i) {
            bool bad = false;
            for (std::size_t f = 0; f < problem.tick.size(); ++f) {
                const double t = problem.tick[f];
                bad |= t >= ticks[i] && t <= ticks[i + 1] && search.errors()[static_cast<Index>(f)] > kLimit;
            }
            if (bad && ticks[i + 1] - ticks[i] > 1) more.push_back((ticks[i] + ticks[i + 1]) / 2);
        }
        if (more.size() == ticks.size()) return search;
        std::sort(more.begin(), more.end());
        ticks = more;
    }
}

// A part of a problem: rows [first, last) as via points, and the samples that those between `begin` and `end`
// move. kMargin rows to either side of these make their B-splines whole.
struct Window {
    std::size_t first, last, begin, end;
};

Window window_around(const std::vector<int>& ticks, std::size_t j, bool first_fixed) {
    Window w{0, ticks.size(), std::max<std::size_t>(j > kReach ? j - kReach : 0, first_fixed),
             std::min(j + kReach + 1, ticks.size())};
    if (w.begin > kMargin + 3) w.first = w.begin - kMargin;
    if (w.end + kMargin + 3 < ticks.size()) w.last = w.end + kMargin;
    return w;
}

Problem part_of(const Problem& problem, const std::vector<int>& ticks, const Window& w) {
    const double from = ticks[w.begin > 3 ? w.begin - 3 : 0],
                 to = ticks[std::min(w.end + 2, ticks.size() - 1)];
    const auto begin = std::lower_bound(problem.tick.begin(), problem.tick.end(), from);
    const auto end = std::upper_bound(begin, problem.tick.end(), to);
    const Index at = begin - problem.tick.begin(), n = end - begin;
    return {std::vector<double>(begin, end),      problem.mode_rows, problem.wanted.middleCols(at, n),
            problem.components.middleRows(at, n), problem.cost,      problem.step,
            problem.first_fixed && w.first == 0};
}

// The search with other via times around via point j, settled there; taken when it costs less.
bool try_times(const Problem& problem, Search& search, std::vector<int> ticks, std::vector<ViaValues> values,
               std::size_t j) {
    const Window w = window_around(ticks, j, problem.first_fixed);
    const Problem part = part_of(problem, ticks, w);
    const auto cut = [&](const auto& rows) {
        return std::decay_t<decltype(rows)>(rows.begin() + static_cast<std::ptrdiff_t>(w.first),
                                            rows.begin() + static_cast<std::ptrdiff_t>(w.last));
    };
    const std::size_t begin = w.begin - w.first, end = w.end - w.first;
    std::vector<int> own_ticks = cut(ticks);
    std::vector<ViaValues> own_values = cut(values);
    if (part.tick.empty()) return false;
    fit_between(part, own_ticks, own_values, begin, end);
    Search other(part, std::move(own_ticks), std::move(own_values));
    other.settle(begin, end, kPenalty, 4);
    if (!other.within() && other.excess() < 1.0) other.settle(begin, end, kHard, 4);
    if (!other.within() && other.excess() < kNear) other.unblock(begin, end, 2);
    if (!other.within()) return false;
    const std::size_t touched = std::min(w.end + 2, ticks.size()), behind = ticks.size() - touched;
    if (other.bits(begin, touched - w.first) >= search.bits(w.begin, search.ticks().size() - behind) - 1e-6)
        return false;
    std::copy(other.values().begin() + static_cast<std::ptrdiff_t>(begin),
              other.values().begin() + static_cast<std::ptrdiff_t>(end),
              values.begin() + static_cast<std::ptrdiff_t>(w.begin));
    search = Search(problem, std::move(ticks), std::move(values));
    return true;
}

// Whether even free control values at every tick leave far more than the bound.
bool hopeless(const Problem& problem, const std::vector<int>& ticks) {
    std::vector<int> all(ticks.begin(), ticks.begin() + static_cast<std::ptrdiff_t>(inner_begin(ticks)));
    for (int t = ticks.front() + 1; t < ticks.back(); ++t) all.push_back(t);
    all.insert(all.end(), ticks.begin() + static_cast<std::ptrdiff_t>(inner_end(ticks)), ticks.end());
    const RowMatrix response = control_weights(all, problem.tick);
    Eigen::MatrixXd normal = response.transpose() * response;
    normal.diagonal().array() += 1e-6;
    const RowMatrix drawn = response * normal.ldlt().solve(response.transpose() * problem.components);
    const Eigen::MatrixXf off =
        problem.mode_rows * (drawn / problem.step).transpose().cast<float>() - problem.wanted;
    return off.cwiseAbs().maxCoeff() > kHopeless;
}

// Each via point but those of the ends: taken out where that costs less.
void thin_out(const Problem& problem, Search& search) {
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
void shift_times(const Problem& problem, Search& search) {
    for (std::size_t j = inner_begin(search.ticks()); j < inner_end(search.ticks()); ++j) {
        for (const int by : {-1, 1}) {
            std::vector<int> ticks = search.ticks();
            ticks[j] += by;
            if (ticks[j] <= ticks[j - 1] || ticks[j] >= ticks[j + 1]) continue;
            if (try_times(problem, search, std::move(ticks), search.values(), j)) break;
        }
    }
}

void polish(Search& search) {
    const std::size_t all = search.ticks().size();
    search.settle(0, all, kPenalty, 6);
    search.sweep_pairs(0, all, kHard);
    search.settle(0, all, kHard, 6);
    search.refresh();
}

// Points as all x, all y, all z, in bounds.
Problem problem_of(const SegmentTarget& target, const Eigen::MatrixXd& modes, const StreamCost& cost,
                   const SearchOptions& options, bool first_fixed) {
    const Index p = modes.rows() / 3;
    Problem problem{target.tick,
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
    problem.components = modes.completeOrthogonalDecomposition().solve(target.points.transpose()).transpose();
    return problem;
}

}  // namespace

QuantisedSegment search_segment(const SegmentTarget& target, const Eigen::MatrixXd& modes,
                                const StreamStatistics& statistics, std::vector<int> ticks,
                                const ViaValues& first, const SearchOptions& options) {
    const StreamCost cost(statistics);
    const Problem problem = problem_of(target, modes, cost, options, !first.empty());
    if (hopeless(problem, ticks)) return {ticks, fitted(problem, ticks, first)};
    Search search = repaired(problem, std::move(ticks), first);
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

double segment_bits(const QuantisedSegment& segment, const StreamStatistics& statistics) {
    const StreamCost cost(statistics);
    double sum = 0;
    for (std::size_t j = 0; j < segment.tick.size(); ++j) sum += cost.event(segment.tick, segment.values, j);
    return sum;
}

}  // namespace viaface
