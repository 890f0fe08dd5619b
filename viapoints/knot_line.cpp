#include "viapoints/knot_line.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kReach = 2;                // control points moved beyond those whose basis functions change
constexpr int kContext = 9;              // knots beyond those that the rows of a stretch depend on
constexpr int kRounds = 10;              // of a fit
constexpr int kReliefRounds = 3;         // of one that is to relieve, not only to hold
constexpr double kRelief = 0.98;         // of the strain there was: a shift that wins less is none
constexpr double kStrained = 1.1;        // of the strain of the strands so far: no use to look at the others
constexpr double kStale = 2;             // growth of importance at which a knot has to wait its turn again
constexpr int kWidestSpread = 2;         // gaps to either side that are widened when a knot goes
constexpr double kRatioRounding = 1e-3;  // times are read from text

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double fourth_power(double x) { return x * x * x * x; }

std::vector<Strand> strands_of(const AnalysisTarget& target) {
    const Index dimensions = target.values.cols();
    const bool points = target.modes.size() == 0 && dimensions % 3 == 0;
    const Index width = points ? 3 : dimensions;
    std::vector<Strand> strands(static_cast<std::size_t>(dimensions / width));
    for (std::size_t s = 0; s < strands.size(); ++s) {
        const Index samples = target.values.rows(), quads = (width + 3) / 4;
        strands[s].quads = static_cast<int>(quads);
        strands[s].value.assign(static_cast<std::size_t>(samples * quads), Quad::Zero());
        strands[s].emphasis.assign(static_cast<std::size_t>(samples), 1.0);
        strands[s].miss.assign(static_cast<std::size_t>(samples), 0.0);
        for (Index i = 0; i < samples; ++i) {
            for (Index d = 0; d < width; ++d) {
                strands[s].value[static_cast<std::size_t>(i * quads + d / 4)][d % 4] =
                    target.values(i, static_cast<Index>(s) * width + d);
            }
        }
    }
    return strands;
}

PointMeasure measure_of(const AnalysisTarget& target, int quads) {
    PointMeasure measure{RowMatrix(), target.residual};
    if (target.modes.size() == 0) return measure;
    measure.modes = RowMatrix::Zero(4 * quads, target.modes.cols());
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
      fits_(strands_.size()),
      held_(strands_.size()) {
    measure_ = measure_of(target, strands_.front().quads);
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
}

// How hard the limit presses in the stretch: dominated by the worst samples.
double KnotLine::strain(std::size_t strand) const {
    double sum = 0;
    const double* miss = &strands_[strand].miss[stretch_.fit.first_sample];
    for (std::size_t i = 0; i < stretch_.fit.rows.size(); ++i) sum += fourth_power(miss[i] / limit_mm2_);
    return sum;
}

bool KnotLine::fits(Aim aim) {
    double strained = 0, was = 0;
    for (std::size_t o = 0; o < order_.size(); ++o) {
        const std::size_t s = order_[o];
        std::vector<Quad>& held = held_[s];
        const auto quads = at(strands_[s].quads);
        held.assign(stretch_.ids.size() * quads, Quad::Zero());
        for (std::size_t i = 0; i < stretch_.ids.size(); ++i) {
            if (stretch_.ids[i] == kNone) continue;
            std::copy_n(&controls_[s][at(stretch_.ids[i]) * quads], quads, &held[i * quads]);
        }
        const int rounds = aim == Aim::kRelief ? kReliefRounds : kRounds;
        bool good = fits_[s].within(strands_[s], measure_, stretch_.fit, held, limit_mm2_, rounds);
        evaluations_ += stretch_.fit.rows.size();
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
        const auto quads = at(strands_[s].quads);
        for (int i = fit.free_begin; i < fit.free_end; ++i) {
            std::copy_n(&fits_[s].control[at(i - fit.free_begin) * quads], quads,
                        &controls_[s][at(stretch_.ids[at(i)]) * quads]);
        }
        const auto first = static_cast<std::ptrdiff_t>(fit.first_sample);
        std::copy(fits_[s].emphasis.begin(), fits_[s].emphasis.end(), strands_[s].emphasis.begin() + first);
        std::copy(fits_[s].miss.begin(), fits_[s].miss.end(), strands_[s].miss.begin() + first);
    }
    for (int i = fit.free_begin; i < fit.free_end; ++i) knot(stretch_.ids[at(i)]).open = true;
}

// What a knot adds: the jump of the fifth derivative, times the fifth power of the room about it. Near the
// ends nothing is known of it, and it is tried first.
double KnotLine::importance(int id) const {
    std::array<int, 11> near;
    near[5] = id;
    for (std::size_t i = 5; i-- > 0;) near[i] = before(near[i + 1], 1);
    for (std::size_t i = 6; i < near.size(); ++i) near[i] = after(near[i - 1], 1);
    if (near[2] == near[3] || near[8] == near[7]) return 0;
    std::array<double, 11> times;
    for (std::size_t i = 0; i < near.size(); ++i) times[i] = time(near[i]);
    const std::array<double, 7> weights = fifth_derivative_jump(times);
    double jump2 = 0;
    for (std::size_t s = 0; s < strands_.size(); ++s) {
        const auto quads = at(strands_[s].quads);
        for (std::size_t k = 0; k < quads; ++k) {
            Quad jump = Quad::Zero();
            for (std::size_t i = 0; i < weights.size(); ++i)
                jump += weights[i] * controls_[s][at(near[i + 2]) * quads + k];
            jump2 += jump.square().sum();
        }
    }
    const double left = times[5] - times[4], right = times[6] - times[5];
    return std::sqrt(jump2) * std::pow(left * right / (left + right), 5);
}

// Takes one knot out of those about this one, and spreads the rest evenly over what was there.
bool KnotLine::spread_out(int id, int reach) {
    const int left = before(id, reach), right = after(id, reach);
    std::vector<double> places;
    for (int at = left;; at = knot(at).after) {
        places.push_back(static_cast<double>(knot(at).sample));
        if (at == right) break;
    }
    const std::size_t gaps = places.size() - 1;
    if (gaps < 3) return false;
    std::vector<std::size_t> between;
    std::size_t last = knot(left).sample;
    for (std::size_t i = 1; i + 1 < gaps; ++i) {
        const double place = static_cast<double>(i * gaps) / static_cast<double>(gaps - 1);
        const auto whole = static_cast<std::size_t>(place);
        const double part = place - static_cast<double>(whole);
        between.push_back(static_cast<std::size_t>(
            std::lround(places[whole] + part * (places[whole + 1] - places[whole]))));
        if (between.back() <= last) return false;
        last = between.back();
    }
    return last < knot(right).sample && replace(left, right, between);
}

bool KnotLine::take_out(int id) {
    if (replace(knot(id).before, knot(id).after, {})) return true;
    for (int reach = 2; reach <= kWidestSpread; ++reach) {
        if (spread_out(id, reach)) return true;
    }
    return false;
}

std::size_t KnotLine::thin() {
    using Turn = std::pair<double, int>;
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns;  // the least important first
    for (const int id : all()) {
        if (inner(id) && knot(id).open) turns.emplace(importance(id), id);
    }
    std::size_t taken = 0;
    while (!turns.empty()) {
        const auto [known, id] = turns.top();
        turns.pop();
        if (!knot(id).alive) continue;
        if (const double now = importance(id); now > kStale * known) {
            turns.emplace(now, id);
            continue;
        }
        knot(id).open = false;
        taken += take_out(id);
    }
    return taken;
}

std::size_t KnotLine::shift() {
    std::size_t moved = 0;
    for (const int id : all()) {
        if (!inner(id)) continue;
        const int left = knot(id).before, right = knot(id).after;
        for (const std::size_t sample : {knot(id).sample + 1, knot(id).sample - 1}) {
            if (sample <= knot(left).sample || sample >= knot(right).sample) continue;
            if (!replace(left, right, {sample}, Aim::kRelief)) continue;
            ++moved;
            break;
        }
    }
    return moved;
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
            const auto s = static_cast<std::size_t>(d / width),
                       quad = static_cast<std::size_t>(d % width / 4);
            for (int r = 0; r < kSupport && row.first + r <= last; ++r) {
                const std::size_t control = at(ids[at(row.first + r)]) * at(strands_[s].quads) + quad;
                track.points(i, d) += row.weight[at(r)] * controls_[s][control][d % width % 4];
            }
        }
    }
    return track;
}

}  // namespace viaface
