#include "viapoints/knot_line.hpp"

#include <algorithm>

#include "viapoints/hermite.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kSeedSamples = 64;
constexpr int kReach = 8;  // knots to either side that a change is solved over: 0.431^8 = 0.001
constexpr int kPruningPasses = 4;

}  // namespace

RowMatrix AnalysisTarget::differences(std::size_t first, const RowMatrix& recovered) const {
    const auto from = static_cast<Index>(first);
    const RowMatrix difference = values.middleRows(from, recovered.rows()) - recovered;
    if (modes.size() == 0) return difference;
    return difference * modes + residual.middleRows(from, recovered.rows());
}

KnotLine::KnotLine(const AnalysisTarget& target) : target_(target) {
    const std::size_t last = target.time_s.size() - 1;
    for (std::size_t sample = 0; sample < last; sample += kSeedSamples) {
        knots_.push_back({.sample = sample, .point = target.values.row(static_cast<Index>(sample))});
    }
    knots_.push_back({.sample = last, .point = target.values.row(static_cast<Index>(last))});
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
        knots_[i].after = static_cast<int>(i + 1);
        knots_[i + 1].before = static_cast<int>(i);
    }
    settle();
}

std::vector<int> KnotLine::all() const {
    std::vector<int> ids;
    for (int id = 0; id != kNone; id = knot(id).after) ids.push_back(id);
    return ids;
}

std::vector<int> KnotLine::around(int id, bool without_it) const {
    std::vector<int> ids;
    for (int at = knot(id).before, n = 0; at != kNone && n < kReach; at = knot(at).before, ++n)
        ids.push_back(at);
    std::reverse(ids.begin(), ids.end());
    if (!without_it) ids.push_back(id);
    for (int at = knot(id).after, n = 0; at != kNone && n < kReach; at = knot(at).after, ++n)
        ids.push_back(at);
    return ids;
}

// Solved over the knots given; beyond them the line stays as it is.
KnotLine::Window KnotLine::solved(std::vector<int> ids) const {
    std::vector<double> times;
    RowMatrix points(static_cast<Index>(ids.size()), target_.values.cols());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        times.push_back(target_.time_s[knot(ids[i]).sample]);
        points.row(static_cast<Index>(i)) = knot(ids[i]).point;
    }
    const auto end = [&](int id, int beyond) {
        if (beyond == kNone) return SplineEnd::natural();
        return SplineEnd{SplineEnd::Kind::kClamped, knot(id).velocity.transpose(),
                         knot(id).acceleration.transpose()};
    };
    const SplineEnd first = end(ids.front(), knot(ids.front()).before),
                    last = end(ids.back(), knot(ids.back()).after);
    return {std::move(ids), MinimumJerkSystem(times, first.kind, last.kind).solve(points, first, last)};
}

KnotLine::SegmentError KnotLine::segment_error(const Window& window, std::size_t segment) {
    const Knot &left = knot(window.knots[segment]), &right = knot(window.knots[segment + 1]);
    const auto count = static_cast<Index>(right.sample - left.sample) - 1;
    if (count == 0) return {};
    const auto row = static_cast<Index>(segment);
    RowMatrix ends(6, target_.values.cols());
    ends << left.point, window.solution.velocity.row(row), window.solution.acceleration.row(row), right.point,
        window.solution.velocity.row(row + 1), window.solution.acceleration.row(row + 1);
    const double begin = target_.time_s[left.sample], h = target_.time_s[right.sample] - begin;
    RowMatrix weights(count, 6);
    for (Index i = 0; i < count; ++i) {
        const double x = (target_.time_s[left.sample + 1 + static_cast<std::size_t>(i)] - begin) / h;
        const HermiteWeights w = hermite_weights(h, x, 0);
        weights.row(i) << w.p0, w.v0, w.a0, w.p1, w.v1, w.a1;
    }
    evaluations_ += static_cast<std::size_t>(count);
    const RowMatrix differences = target_.differences(left.sample + 1, weights * ends);
    SegmentError found;
    for (Index i = 0; i < count; ++i) {
        const double distance = longest_triple(differences.row(i));
        if (distance > found.error) found = {distance, left.sample + 1 + static_cast<std::size_t>(i)};
    }
    return found;
}

void KnotLine::adopt(const Window& window) {
    for (std::size_t i = 0; i < window.knots.size(); ++i) {
        Knot& at = knot(window.knots[i]);
        at.velocity = window.solution.velocity.row(static_cast<Index>(i));
        at.acceleration = window.solution.acceleration.row(static_cast<Index>(i));
        if (i + 1 == window.knots.size()) break;
        const SegmentError segment = segment_error(window, i);
        at.error = segment.error;
        at.worst = segment.worst;
        worst_.push({at.error, at.worst, window.knots[i]});
    }
}

void KnotLine::settle() {
    worst_ = {};
    adopt(solved(all()));
}

void KnotLine::insert_at(int segment_begin) {
    const int id = static_cast<int>(knots_.size()), after = knot(segment_begin).after;
    const std::size_t sample = knot(segment_begin).worst;
    knots_.push_back({.sample = sample,
                      .before = segment_begin,
                      .after = after,
                      .point = target_.values.row(static_cast<Index>(sample))});
    knot(segment_begin).after = id;
    knot(after).before = id;
    adopt(solved(around(id, false)));
}

void KnotLine::insert_until_within(double limit_mm) {
    while (!worst_.empty() && worst_.top().error > limit_mm) {
        const Worst top = worst_.top();
        worst_.pop();
        const Knot& at = knot(top.knot);
        const bool current = at.alive && at.error == top.error && at.worst == top.sample;
        if (current) insert_at(top.knot);
    }
}

// The error of the segment that joins the neighbours when this knot goes.
double KnotLine::error_without(int id) {
    const Window window = solved(around(id, true));
    const auto left =
        std::find(window.knots.begin(), window.knots.end(), knot(id).before) - window.knots.begin();
    return segment_error(window, static_cast<std::size_t>(left)).error;
}

bool KnotLine::take_out(int id, double limit_mm) {
    const Window window = solved(around(id, true));
    for (std::size_t i = 0; i + 1 < window.knots.size(); ++i) {
        if (segment_error(window, i).error > limit_mm) return false;
    }
    Knot& gone = knot(id);
    gone.alive = false;
    knot(gone.before).after = gone.after;
    knot(gone.after).before = gone.before;
    adopt(window);
    return true;
}

void KnotLine::take_out_what_is_spare(double limit_mm) {
    for (int pass = 0; pass < kPruningPasses; ++pass) {
        std::vector<std::pair<double, int>> order;  // the least missed first
        for (const int id : all()) {
            if (knot(id).before != kNone && knot(id).after != kNone)
                order.emplace_back(error_without(id), id);
        }
        std::sort(order.begin(), order.end());
        std::size_t taken = 0;
        for (const auto& [error, id] : order) {
            if (error > 2 * limit_mm) break;  // far beyond what changes next to it can mend
            taken += take_out(id, limit_mm);
        }
        if (taken == 0) return;
    }
}

double KnotLine::largest_error_mm() const {
    double largest = 0;
    for (const int id : all()) largest = std::max(largest, knot(id).error);
    return largest;
}

ViaPointTrack KnotLine::track() const {
    const std::vector<int> ids = all();
    ViaPointTrack track{{}, RowMatrix(static_cast<Index>(ids.size()), target_.values.cols())};
    for (std::size_t i = 0; i < ids.size(); ++i) {
        track.time_s.push_back(target_.time_s[knot(ids[i]).sample]);
        track.points.row(static_cast<Index>(i)) = knot(ids[i]).point;
    }
    return track;
}

}  // namespace viaface
