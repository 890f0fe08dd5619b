// Knots put in until plain least squares stays within the limit: KnotLine::fill.
#include <algorithm>

#include "viapoints/knot_line.hpp"

namespace viaface {
namespace {

constexpr std::size_t kSparsest = 16;  // samples from knot to knot before any are put in

std::size_t middle(const std::vector<std::size_t>& samples, std::size_t gap) {
    return (samples[gap] + samples[gap + 1]) / 2;
}

// The gaps marked, cut in half.
std::vector<std::size_t> halved(const std::vector<std::size_t>& samples, const std::vector<bool>& marked) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        result.push_back(samples[i]);
        if (marked[i] && samples[i + 1] - samples[i] > 1) result.push_back(middle(samples, i));
    }
    result.push_back(samples.back());
    return result;
}

}  // namespace

std::vector<std::size_t> KnotLine::evenly() const {
    const std::size_t last = target_.time_s.size() - 1;
    std::vector<std::size_t> samples;
    for (std::size_t sample = 0; sample + kSparsest / 2 < last; sample += kSparsest)
        samples.push_back(sample);
    if (samples.size() < 2) samples = {0, last / 2};
    samples.push_back(last);
    return samples;
}

// Gaps with a sample beyond the limit, or, where those cannot be cut, the nearest ones that can.
std::vector<std::size_t> KnotLine::split(const std::vector<std::size_t>& samples) const {
    const std::size_t gaps = samples.size() - 1;
    const auto beyond = [&](std::size_t gap) {
        return std::any_of(fits_.begin(), fits_.end(), [&](const BraidFit& fit) {
            return std::any_of(
                &fit.miss[samples[gap]], &fit.miss[samples[gap + 1]] + 1, [&](const Lanes& miss) {
                    return std::ranges::any_of(miss.lane, [&](double one) { return one > limit_mm2_; });
                });
        });
    };
    const auto wide = [&](std::size_t gap) { return samples[gap + 1] - samples[gap] > 1; };
    std::vector<bool> marked(gaps);
    for (std::size_t gap = 0; gap < gaps; ++gap) {
        if (!beyond(gap)) continue;
        std::size_t below = gap, above = gap;
        while (below > 0 && !wide(below)) --below;
        while (above + 1 < gaps && !wide(above)) ++above;
        marked[wide(below) && (gap - below <= above - gap || !wide(above)) ? below : above] = true;
    }
    return halved(samples, marked);
}

// Gaps are cut until none exceeds a neighbour by more than the ratio, as far as samples allow.
std::vector<std::size_t> KnotLine::graded(std::vector<std::size_t> samples) const {
    const auto gap = [&](std::size_t i) {
        return target_.time_s[samples[i + 1]] - target_.time_s[samples[i]];
    };
    while (true) {
        std::vector<bool> marked(samples.size() - 1);
        for (std::size_t i = 0; i < marked.size(); ++i) {
            marked[i] = (i > 0 && gap(i) > max_gap_ratio_ * gap(i - 1)) ||
                        (i + 1 < marked.size() && gap(i) > max_gap_ratio_ * gap(i + 1));
        }
        std::vector<std::size_t> more = halved(samples, marked);
        if (more.size() == samples.size()) return samples;
        samples = std::move(more);
    }
}

void KnotLine::set_line(const std::vector<std::size_t>& samples) {
    const int count = static_cast<int>(samples.size());
    knots_.clear();
    for (int i = 0; i < count; ++i) {
        knots_.push_back({.sample = samples[static_cast<std::size_t>(i)],
                          .before = i - 1,
                          .after = i + 1 < count ? i + 1 : kNone});
    }
    for (std::size_t b = 0; b < braids_.size(); ++b) {
        controls_[b] = fits_[b].control;
        braids_[b].miss = fits_[b].miss;
    }
}

void KnotLine::fill() {
    std::vector<std::size_t> samples = graded(evenly());
    while (true) {
        stretch_ = {};
        stretch_.samples = samples;
        stretch_.ids.assign(samples.size(), kNone);
        stretch_.first_is_end = stretch_.last_is_end = true;
        for (const std::size_t sample : samples) stretch_.times.push_back(target_.time_s[sample]);
        stretch_.fit.controls = stretch_.fit.free_end = static_cast<int>(samples.size());
        find_rows();
        for (std::size_t b = 0; b < braids_.size(); ++b) {
            hold(b);
            fit(b, 1);
        }
        std::vector<std::size_t> more = split(samples);
        if (more.size() == samples.size()) break;
        samples = graded(std::move(more));
    }
    set_line(samples);
}

}  // namespace viaface
