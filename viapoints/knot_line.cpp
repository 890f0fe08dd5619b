#include "viapoints/knot_line.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "viapoints/hermite.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kSeedSamples = 64;
constexpr int kReach = 8;  // knots to either side that a change is solved over: 0.431^8 = 0.001
constexpr int kPruningPasses = 4;
constexpr int kRefitReach = 3;  // points to either side of a gap that are moved when one goes
constexpr int kRefitRounds = 8;
constexpr double kHopeless = 4;  // limits beyond which moving the neighbours is not tried

std::size_t place_of(const std::vector<int>& ids, int id) {
    return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

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

KnotLine::Window KnotLine::gathered(std::vector<int> ids) const {
    Window window{std::move(ids), {}, {}};
    window.points.resize(static_cast<Index>(window.knots.size()), target_.values.cols());
    for (std::size_t i = 0; i < window.knots.size(); ++i) {
        window.points.row(static_cast<Index>(i)) = knot(window.knots[i]).point;
    }
    return window;
}

// Ends of the line are natural; beyond a window's other ends the line stays as it is.
MinimumJerkSystem KnotLine::system(const Window& window) const {
    std::vector<double> times;
    for (const int id : window.knots) times.push_back(target_.time_s[knot(id).sample]);
    const auto kind = [](int beyond) {
        return beyond == kNone ? SplineEnd::Kind::kNatural : SplineEnd::Kind::kClamped;
    };
    return {std::move(times), kind(knot(window.knots.front()).before), kind(knot(window.knots.back()).after)};
}

void KnotLine::solve(Window& window) const {
    const auto end = [&](int id, int beyond) {
        if (beyond == kNone) return SplineEnd::natural();
        return SplineEnd{SplineEnd::Kind::kClamped, knot(id).velocity.transpose(),
                         knot(id).acceleration.transpose()};
    };
    const int first = window.knots.front(), last = window.knots.back();
    window.solution =
        system(window).solve(window.points, end(first, knot(first).before), end(last, knot(last).after));
}

// How the window's spline answers to a unit change of each of `count` points: one dimension for each.
KnotLine::Window KnotLine::unit_responses(const Window& window, Index first, Index count) const {
    Window units{window.knots, RowMatrix::Zero(window.points.rows(), count), {}};
    units.points.middleRows(first, count).setIdentity();
    const auto end = [](int beyond) { return beyond == kNone ? SplineEnd::natural() : SplineEnd::at_rest(); };
    units.solution = system(window).solve(units.points, end(knot(window.knots.front()).before),
                                          end(knot(window.knots.back()).after));
    return units;
}

// The spline at the target's samples from one knot to the next, both included.
RowMatrix KnotLine::sampled(const Window& window, std::size_t segment) const {
    const Knot &left = knot(window.knots[segment]), &right = knot(window.knots[segment + 1]);
    const auto row = static_cast<Index>(segment);
    RowMatrix ends(6, window.points.cols());
    ends << window.points.row(row), window.solution.velocity.row(row), window.solution.acceleration.row(row),
        window.points.row(row + 1), window.solution.velocity.row(row + 1),
        window.solution.acceleration.row(row + 1);
    const double begin = target_.time_s[left.sample], h = target_.time_s[right.sample] - begin;
    RowMatrix weights(static_cast<Index>(right.sample - left.sample) + 1, 6);
    for (Index i = 0; i < weights.rows(); ++i) {
        const double x = (target_.time_s[left.sample + static_cast<std::size_t>(i)] - begin) / h;
        const HermiteWeights w = hermite_weights(h, x, 0);
        weights.row(i) << w.p0, w.v0, w.a0, w.p1, w.v1, w.a1;
    }
    return weights * ends;
}

RowMatrix KnotLine::sampled(const Window& window) const {
    const std::size_t first = knot(window.knots.front()).sample, last = knot(window.knots.back()).sample;
    RowMatrix rows(static_cast<Index>(last - first) + 1, window.points.cols());
    for (std::size_t i = 0; i + 1 < window.knots.size(); ++i) {
        const RowMatrix part = sampled(window, i);
        rows.middleRows(static_cast<Index>(knot(window.knots[i]).sample - first), part.rows()) = part;
    }
    return rows;
}

KnotLine::SegmentError KnotLine::segment_error(const Window& window, std::size_t segment) {
    const std::size_t first = knot(window.knots[segment]).sample;
    const RowMatrix differences = target_.differences(first, sampled(window, segment));
    evaluations_ += static_cast<std::size_t>(differences.rows());
    SegmentError found{0, first};
    for (Index i = 0; i < differences.rows(); ++i) {
        const double distance = longest_triple(differences.row(i));
        if (distance > found.error) found = {distance, first + static_cast<std::size_t>(i)};
    }
    return found;
}

bool KnotLine::within(const Window& window, double limit_mm) {
    for (std::size_t i = 0; i + 1 < window.knots.size(); ++i) {
        if (segment_error(window, i).error > limit_mm) return false;
    }
    return true;
}

// Moves the points about `middle` to the least squares of the window's samples, weighted more and more
// towards the worst ones [Lawson61], until all are within the limit; false when that does not come about.
bool KnotLine::refit(Window& window, std::size_t middle, double limit_mm) {
    const auto knots = static_cast<Index>(window.knots.size()), at = static_cast<Index>(middle);
    const Index first = std::max<Index>(0, at - kRefitReach + 1),
                past = std::min(knots, at + kRefitReach + 1);
    const std::size_t from = knot(window.knots.front()).sample;
    const RowMatrix response = sampled(unit_responses(window, first, past - first)), start = sampled(window);
    const RowMatrix wanted = target_.values.middleRows(static_cast<Index>(from), start.rows()) - start;
    Eigen::VectorXd weight = Eigen::VectorXd::Ones(start.rows());
    for (int round = 0; round < kRefitRounds; ++round) {
        const RowMatrix weighted = response.transpose() * weight.asDiagonal();
        const Eigen::MatrixXd change = Eigen::MatrixXd(weighted * response).ldlt().solve(weighted * wanted);
        const RowMatrix differences = target_.differences(from, start + response * change);
        evaluations_ += static_cast<std::size_t>(differences.rows());
        double worst = 0;
        for (Index i = 0; i < differences.rows(); ++i) {
            const double distance = longest_triple(differences.row(i));
            worst = std::max(worst, distance);
            weight[i] *= distance / limit_mm + 0.01;
        }
        if (worst <= limit_mm) {
            window.points.middleRows(first, past - first) += change;
            solve(window);
            return within(window, limit_mm);
        }
        weight /= weight.maxCoeff();
    }
    return false;
}

void KnotLine::adopt(const Window& window) {
    for (std::size_t i = 0; i < window.knots.size(); ++i) {
        Knot& at = knot(window.knots[i]);
        at.point = window.points.row(static_cast<Index>(i));
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
    Window whole = gathered(all());
    solve(whole);
    adopt(whole);
}

// At the segment's worst sample: a new knot, or, when that is a knot's own, the knot's point is put on the
// target.
void KnotLine::insert_at(int segment_begin) {
    const int after = knot(segment_begin).after;
    const std::size_t sample = knot(segment_begin).worst;
    int id = sample == knot(after).sample ? after : segment_begin;
    if (sample != knot(id).sample) {
        id = static_cast<int>(knots_.size());
        knots_.push_back({.sample = sample, .before = segment_begin, .after = after});
        knot(segment_begin).after = id;
        knot(after).before = id;
    }
    knot(id).point = target_.values.row(static_cast<Index>(sample));
    Window window = gathered(around(id, false));
    solve(window);
    adopt(window);
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
    Window window = gathered(around(id, true));
    solve(window);
    return segment_error(window, place_of(window.knots, knot(id).before)).error;
}

bool KnotLine::take_out(int id, double limit_mm) {
    Window window = gathered(around(id, true));
    solve(window);
    if (!within(window, limit_mm) && !refit(window, place_of(window.knots, knot(id).before), limit_mm))
        return false;
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
            if (error > kHopeless * limit_mm) break;
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
