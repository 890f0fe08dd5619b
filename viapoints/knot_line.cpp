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

double fourth_power(double x) { return x * x * x * x; }

std::vector<Strand> strands_of(const AnalysisTarget& target) {
    const Index dimensions = target.values.cols();
    const bool points = target.modes.size() == 0 && dimensions % 3 == 0;
    const Index width = points ? 3 : dimensions;
    std::vector<Strand> strands(static_cast<std::size_t>(dimensions / width));
    for (std::size_t s = 0; s < strands.size(); ++s) {
        const Index samples = target.values.rows(), filled = width == 1 ? 1 : (width + 3) / 4 * 4;
        strands[s].width = static_cast<int>(filled);
        strands[s].value.assign(static_cast<std::size_t>(samples * filled), 0.0);
        strands[s].emphasis.assign(static_cast<std::size_t>(samples), 1.0);
        strands[s].miss.assign(static_cast<std::size_t>(samples), 0.0);
        for (Index i = 0; i < samples; ++i) {
            for (Index d = 0; d < width; ++d)
                strands[s].value[static_cast<std::size_t>(i * filled + d)] =
                    target.values(i, static_cast<Index>(s) * width + d);
        }
    }
    return strands;
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

KnotLine::KnotLine(const AnalysisTarget& target, double limit_mm, double max_gap_ratio)
    : target_(target),
      limit_mm2_(limit_mm * limit_mm),
      max_gap_ratio_(max_gap_ratio * (1 + kRatioRounding)),
      strands_(strands_of(target)),
      controls_(strands_.size()),
      fits_(strands_.size()) {
    measure_ = measure_of(target, strands_.front().width);
    for (std::size_t s = 0; s < strands_.size(); ++s) order_.push_back(s);
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
    for (int segment = first; segment <= last; ++segment) {
        const std::size_t begin = s.samples[at(segment)], end = s.samples[at(segment + 1)];
        basis.append_rows(segment, {&target_.time_s[begin], end - begin + (segment == last ? 1 : 0)},
                          s.fit.rows);
    }
    s.fit.find_products();
}

// How hard the limit presses in the stretch: dominated by the worst samples.
double KnotLine::strain(std::size_t strand) const {
    double sum = 0;
    const double* miss = &strands_[strand].miss[stretch_.fit.first_sample];
    for (std::size_t i = 0; i < stretch_.fit.rows.size(); ++i) sum += fourth_power(miss[i] / limit_mm2_);
    return sum;
}

// The control points that the strand's fit begins with: those that are not free but under its samples.
void KnotLine::hold(std::size_t strand) {
    const auto width = at(strands_[strand].width);
    std::vector<double>& held = fits_[strand].control;
    const int all = stretch_.fit.controls + kSupport - 1;
    held.resize(at(all) * width);
    const auto copy = [&](int from, int to) {
        for (int i = from; i < to; ++i) {
            const int id = i < stretch_.fit.controls ? stretch_.ids[at(i)] : kNone;
            if (id == kNone)
                std::fill_n(&held[at(i) * width], width, 0.0);
            else
                std::copy_n(&controls_[strand][at(id) * width], width, &held[at(i) * width]);
        }
    };
    copy(std::max(0, stretch_.fit.free_begin - 2 * kSupport), stretch_.fit.free_begin);
    copy(stretch_.fit.free_end, std::min(all, stretch_.fit.free_end + 2 * kSupport));
}

bool KnotLine::fit(std::size_t strand, int rounds) {
    Stretch& s = stretch_;
    const bool even = strands_[strand].even(s.fit.first_sample, s.fit.rows.size());
    if (even && !s.even_known) s.even.factor(s.fit, {});
    s.even_known |= even;
    evaluations_ += s.fit.rows.size();
    return fits_[strand].within(strands_[strand], measure_, s.fit, even ? &s.even : nullptr, limit_mm2_,
                                rounds, bench_);
}

bool KnotLine::fits(Aim aim) {
    double strained = 0, was = 0;
    stretch_.even_known = false;
    for (std::size_t o = 0; o < order_.size(); ++o) {
        const std::size_t s = order_[o];
        hold(s);
        bool good = fit(s, aim == Aim::kRelief ? kReliefRounds : kRounds);
        if (good && aim == Aim::kRelief) {
            was += strain(s);
            for (const double miss : fits_[s].miss) strained += fourth_power(miss / limit_mm2_);
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
    for (std::size_t s = 0; s < strands_.size(); ++s) {
        const auto width = at(strands_[s].width);
        for (int i = fit.free_begin; i < fit.free_end; ++i)
            std::copy_n(&fits_[s].control[at(i) * width], width,
                        &controls_[s][at(stretch_.ids[at(i)]) * width]);
        const auto first = static_cast<std::ptrdiff_t>(fit.first_sample);
        std::copy(fits_[s].emphasis.begin(), fits_[s].emphasis.end(), strands_[s].emphasis.begin() + first);
        std::copy(fits_[s].miss.begin(), fits_[s].miss.end(), strands_[s].miss.begin() + first);
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
    const Index dimensions = target_.values.cols(), width = dimensions / std::ssize(strands_);
    track.points = RowMatrix::Zero(last + 1, dimensions);
    for (Index i = 0; i <= last; ++i) {
        const QuinticRow& row = rows[static_cast<std::size_t>(i)];
        for (Index d = 0; d < dimensions; ++d) {
            const auto s = static_cast<std::size_t>(d / width), k = static_cast<std::size_t>(d % width);
            for (int r = 0; r < kSupport && row.first + r <= last; ++r)
                track.points(i, d) +=
                    row.weight[at(r)] * controls_[s][at(ids[at(row.first + r)]) * at(strands_[s].width) + k];
        }
    }
    return track;
}

}  // namespace viaface
