#include "viapoints/knot_line.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kReach = 1;                // control points moved beyond those whose basis functions change
constexpr int kContext = 9;              // knots beyond those that the rows of a stretch depend on
constexpr int kRounds = 10;              // of a fit
constexpr int kReliefRounds = 3;         // of one that is to relieve, not only to hold
constexpr double kRelief = 0.98;         // of the strain there was: a shift that wins less is none
constexpr double kStrained = 1.1;        // of the strain of the strands so far: no use to look at the others
constexpr double kRatioRounding = 1e-3;  // times are read from text

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Where the numbers of a dimension are.
struct Place {
    std::size_t braid = 0, vector = 0, lane = 0;
};

Place place_of(Index dimension, bool points) {
    const auto d = static_cast<std::size_t>(dimension);
    if (points) return {d / 3 / kLanes, d % 3, d / 3 % kLanes};
    return {0, d / kLanes, d % kLanes};
}

bool of_points(const AnalysisTarget& target) {
    return target.modes.size() == 0 && target.values.cols() % 3 == 0;
}

std::vector<Braid> braids_of(const AnalysisTarget& target) {
    const bool points = of_points(target);
    const Index dimensions = target.values.cols();
    const auto samples = static_cast<std::size_t>(target.values.rows());
    std::vector<Braid> braids(place_of(dimensions - 1, points).braid + 1);
    const std::size_t vectors = points ? 3 : place_of(dimensions - 1, false).vector + 1;
    for (Braid& braid : braids) {
        braid.vectors = static_cast<int>(vectors);
        braid.value.assign(samples * vectors, {});
        braid.emphasis.assign(samples, {{1, 1, 1, 1}});
        braid.miss.assign(samples, {});
    }
    for (std::size_t i = 0; i < samples; ++i) {
        for (Index d = 0; d < dimensions; ++d) {
            const auto [b, k, lane] = place_of(d, points);
            braids[b].value[i * vectors + k].lane[lane] = target.values(static_cast<Index>(i), d);
        }
    }
    return braids;
}

PointMeasure measure_of(const AnalysisTarget& target, int width) {
    PointMeasure measure{RowMatrix(), target.residual};
    if (target.modes.size() == 0) return measure;
    measure.modes = RowMatrix::Zero(width, target.modes.cols());
    measure.modes.topRows(target.modes.rows()) = target.modes;
    return measure;
}

}  // namespace

RowMatrix AnalysisTarget::differences(const RowMatrix& recovered) const {
    const RowMatrix difference = values - recovered;
    if (modes.size() == 0) return difference;
    return difference * modes + residual;
}

KnotLine::KnotLine(const AnalysisTarget& target, double limit_mm, double max_gap_ratio,
                   const StrandKernel& kernel)
    : target_(target),
      limit_mm2_(limit_mm * limit_mm),
      max_gap_ratio_(max_gap_ratio * (1 + kRatioRounding)),
      braids_(braids_of(target)),
      controls_(braids_.size()),
      fits_(braids_.size()),
      bench_{.kernel = &kernel} {
    measure_ = measure_of(target, kLanes * braids_.front().vectors);
    for (std::size_t b = 0; b < braids_.size(); ++b) order_.push_back(b);
}

int KnotLine::before(int id, int count) const {
    while (count-- > 0 && knot(id).before != kNone) id = knot(id).before;
    return id;
}

int KnotLine::after(int id, int count) const {
    while (count-- > 0 && knot(id).after != kNone) id = knot(id).after;
    return id;
}

std::vector<int> KnotLine::all() const {
    std::vector<int> ids;
    for (int id = 0; id != kNone; id = knot(id).after) ids.push_back(id);
    return ids;
}

// The knots from `left` to `right` with new ones between them, and as many to either side as the rows of what
// may change depend on.
void KnotLine::gather(int left, int right, const std::vector<std::size_t>& between) {
    Stretch& s = stretch_;
    s.ids.clear();
    s.samples.clear();
    s.times.clear();
    const int first = before(left, kContext + kReach), last = after(right, kContext + kReach);
    const auto add = [&](int from, int to) {
        for (int id = from;; id = knot(id).after) {
            s.ids.push_back(id);
            s.samples.push_back(knot(id).sample);
            if (id == to) return;
        }
    };
    add(first, left);
    s.left = static_cast<int>(s.ids.size()) - 1;
    s.ids.insert(s.ids.end(), between.size(), kNone);
    s.samples.insert(s.samples.end(), between.begin(), between.end());
    s.right = static_cast<int>(s.ids.size());
    add(right, last);
    for (const std::size_t sample : s.samples) s.times.push_back(target_.time_s[sample]);
    s.first_is_end = knot(first).before == kNone;
    s.last_is_end = knot(last).after == kNone;
    s.fit.controls = static_cast<int>(s.ids.size());
    s.fit.free_begin = std::max(0, s.left - 2 - kReach);
    s.fit.free_end = std::min(s.fit.controls, s.right + 3 + kReach);
}

// Neighbouring gaps may differ by the ratio, or as much as those did that they replace.
bool KnotLine::gaps_allowed(int left, int right) const {
    double allowed = max_gap_ratio_;
    const auto ratio = [](double gap, double next) { return std::max(gap / next, next / gap); };
    for (int id = left;; id = knot(id).after) {
        if (inner(id))
            allowed =
                std::max(allowed, ratio(time(id) - time(knot(id).before), time(knot(id).after) - time(id)));
        if (id == right) break;
    }
    const auto& t = stretch_.times;
    for (int i = std::max(1, stretch_.left - 1); i <= stretch_.right + 1 && i + 1 < std::ssize(t); ++i) {
        if (ratio(t[at(i)] - t[at(i - 1)], t[at(i + 1)] - t[at(i)]) > allowed) return false;
    }
    return true;
}

void KnotLine::find_rows() {
    Stretch& s = stretch_;
    const int first = std::max(0, s.fit.free_begin - 3),
              last = std::min(s.fit.controls, s.fit.free_end + 3) - 2;
    const QuinticBasis basis(s.times, s.first_is_end, s.last_is_end);
    s.fit.first_sample = s.samples[at(first)];
    s.fit.rows.clear();
    s.fit.starts = {0};
    for (int segment = first; segment <= last; ++segment) {
        const std::size_t begin = s.samples[at(segment)], end = s.samples[at(segment + 1)];
        basis.append_rows(segment, {&target_.time_s[begin], end - begin + (segment == last ? 1 : 0)},
                          s.fit.rows);
        s.fit.starts.push_back(std::ssize(s.fit.rows));
    }
}

// How hard the limit presses in the stretch: dominated by the worst samples.
double KnotLine::strain(const Lanes* miss) const {
    return bench_.kernel->strain(std::ssize(stretch_.fit.rows), miss, limit_mm2_);
}

// The control points that the braid's fit begins with: those that are not free but under its samples.
void KnotLine::hold(std::size_t braid) {
    const auto vectors = at(braids_[braid].vectors);
    std::vector<Lanes>& held = fits_[braid].control;
    const int all = stretch_.fit.controls + kSupport - 1;
    held.resize(at(all) * vectors);
    const auto copy = [&](int from, int to) {
        for (int i = from; i < to; ++i) {
            const int id = i < stretch_.fit.controls ? stretch_.ids[at(i)] : kNone;
            if (id == kNone)
                std::fill_n(&held[at(i) * vectors], vectors, Lanes{});
            else
                std::copy_n(&controls_[braid][at(id) * vectors], vectors, &held[at(i) * vectors]);
        }
    };
    copy(std::max(0, stretch_.fit.free_begin - kSupport), stretch_.fit.free_begin);
    copy(stretch_.fit.free_end, std::min(all, stretch_.fit.free_end + kSupport));
}

bool KnotLine::fit(std::size_t braid, int rounds) {
    Stretch& s = stretch_;
    const Lanes* emphasis = &braids_[braid].emphasis[s.fit.first_sample];
    const bool even = bench_.kernel->even(std::ssize(s.fit.rows), emphasis);
    if (even && !s.even_known) s.even.factor(*bench_.kernel, s.fit, emphasis);
    s.even_known |= even;
    evaluations_ += s.fit.rows.size();
    return fits_[braid].within(braids_[braid], measure_, s.fit, even ? &s.even : nullptr, limit_mm2_, rounds,
                               bench_);
}

bool KnotLine::fits(Aim aim) {
    double strained = 0, was = 0;
    stretch_.even_known = false;
    for (std::size_t o = 0; o < order_.size(); ++o) {
        const std::size_t b = order_[o];
        hold(b);
        bool good = fit(b, aim == Aim::kRelief ? kReliefRounds : kRounds);
        if (good && aim == Aim::kRelief) {
            was += strain(&braids_[b].miss[stretch_.fit.first_sample]);
            strained += strain(fits_[b].miss.data());
            good = strained <= kStrained * was;
        }
        if (good) continue;
        std::rotate(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(o),
                    order_.begin() + static_cast<std::ptrdiff_t>(o) + 1);
        return false;
    }
    return aim == Aim::kWithin || strained <= kRelief * was;
}

// Puts knots at the samples given in place of those between two, if the spline can stay within the limit.
bool KnotLine::replace(int left, int right, const std::vector<std::size_t>& between, Aim aim) {
    gather(left, right, between);
    if (stretch_.ids.size() < 3 || !gaps_allowed(left, right)) return false;
    find_rows();
    if (!fits(aim)) return false;
    relink(left, right, between);
    adopt();
    return true;
}

void KnotLine::relink(int left, int right, const std::vector<std::size_t>& between) {
    std::vector<int> spare;
    for (int id = knot(left).after; id != right; id = knot(id).after) {
        knot(id).alive = false;
        spare.push_back(id);
    }
    int last = left;
    for (std::size_t i = 0; i < between.size(); ++i) {
        const int id = spare[i];
        knot(id) = {.sample = between[i], .before = last};
        knot(last).after = id;
        stretch_.ids[at(stretch_.left + 1) + i] = last = id;
    }
    knot(last).after = right;
    knot(right).before = last;
}

void KnotLine::adopt() {
    const FitStretch& fit = stretch_.fit;
    for (std::size_t b = 0; b < braids_.size(); ++b) {
        const auto vectors = at(braids_[b].vectors);
        for (int i = fit.free_begin; i < fit.free_end; ++i)
            std::copy_n(&fits_[b].control[at(i) * vectors], vectors,
                        &controls_[b][at(stretch_.ids[at(i)]) * vectors]);
        std::ranges::copy(fits_[b].emphasis, &braids_[b].emphasis[fit.first_sample]);
        std::ranges::copy(fits_[b].miss, &braids_[b].miss[fit.first_sample]);
    }
    for (int i = fit.free_begin; i < fit.free_end; ++i) knot(stretch_.ids[at(i)]).open = true;
}

ViaPointTrack KnotLine::track() const {
    const std::vector<int> ids = all();
    ViaPointTrack track;
    for (const int id : ids) track.time_s.push_back(time(id));
    std::vector<QuinticRow> rows;
    const QuinticBasis basis(track.time_s, true, true);
    const int last = static_cast<int>(ids.size()) - 1;
    for (int i = 0; i <= last; ++i) basis.append_rows(std::min(i, last - 1), {&track.time_s[at(i)], 1}, rows);
    track.points = RowMatrix::Zero(last + 1, target_.values.cols());
    for (Index i = 0; i <= last; ++i) {
        const QuinticRow& row = rows[static_cast<std::size_t>(i)];
        for (Index d = 0; d < track.points.cols(); ++d) {
            const auto [b, k, lane] = place_of(d, of_points(target_));
            const auto vectors = at(braids_[b].vectors);
            for (int r = 0; r < kSupport && row.first + r <= last; ++r)
                track.points(i, d) +=
                    row.weight[r] * controls_[b][at(ids[at(row.first + r)]) * vectors + k].lane[lane];
        }
    }
    return track;
}

}  // namespace viaface
