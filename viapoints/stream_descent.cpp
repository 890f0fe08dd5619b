#include "viapoints/stream_descent.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Index;

constexpr float kSmallResponse = 1e-4f;
constexpr float kTouching = 0.05f;
constexpr double kGain = 1e-6;  // bits

Eigen::MatrixXf as_matrix(const std::vector<ViaValues>& values, Index components) {
    Eigen::MatrixXf q(static_cast<Index>(values.size()), components);
    for (Index j = 0; j < q.rows(); ++j)
        for (Index k = 0; k < components; ++k)
            q(j, k) = static_cast<float>(values[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)]);
    return q;
}

}  // namespace

StreamDescent::StreamDescent(const SearchProblem& problem, std::vector<int> ticks,
                             std::vector<ViaValues> values)
    : problem_(&problem),
      tick_(std::move(ticks)),
      values_(std::move(values)),
      response_(control_weights(tick_, problem.tick).cast<float>()),
      rows_(values_.size()),
      open_(values_.size(), true) {
    for (Index j = 0; j < response_.cols(); ++j) {
        Index from = 0, to = response_.rows();
        while (from < to && response_(from, j) < kSmallResponse) ++from;
        while (to > from && response_(to - 1, j) < kSmallResponse) --to;
        from_.push_back(from);
        to_.push_back(to);
    }
    for (std::size_t n = 0; n < rows_.size(); ++n) cost_row(n, true);
    weight_ = Eigen::ArrayXf::Ones(response_.rows());
    refresh();
}

void StreamDescent::refresh() {
    off_ = problem_->mode_rows * (response_ * as_matrix(values_, problem_->mode_rows.cols())).transpose() -
           problem_->wanted;
    const Index p = problem_->points();
    error_ = (off_.topRows(p).array().square() + off_.middleRows(p, p).array().square() +
              off_.bottomRows(p).array().square())
                 .colwise()
                 .maxCoeff()
                 .transpose();
}

double StreamDescent::bits(std::size_t begin, std::size_t end) const {
    double sum = 0;
    for (std::size_t n = begin; n < end; ++n) sum += rows_[n].bits;
    return sum;
}

double StreamDescent::gap_bits(std::size_t n) const {
    if (n == 0 || tick_[n] == tick_[n - 1]) return 0;
    const bool still = n > 1 && values_[n - 1] == values_[n - 2];
    const int before = n > 1 ? tick_[n - 1] - tick_[n - 2] : 0;
    return problem_->cost.gap(gap_context(before > 0 ? before : kFirstGap, still), tick_[n] - tick_[n - 1]);
}

// What row n costs now; its sums anew, unless they have followed its change.
void StreamDescent::cost_row(std::size_t n, bool anew) {
    const ViaValues zeros(n == 0 ? values_[0].size() : 0);
    const ViaPast past = past_of(values_, n, zeros);
    Row& row = rows_[n];
    const int row_class = viaface::row_class(past, n > 0 ? tick_[n] - tick_[n - 1] : 0);
    if (anew || row_class != row.row_class) {
        row.row_class = row_class;
        problem_->cost.predict(row_class, past, values_[n], row.sums);
    }
    row.bits = gap_bits(n) + problem_->cost.values(row_class, row.sums, values_[n]);
}

void StreamDescent::settle(std::size_t begin, std::size_t end, double penalty, int most) {
    for (int i = 0; i < most && sweep(begin, end, penalty); ++i) {
    }
}

bool StreamDescent::sweep(std::size_t begin, std::size_t end, double penalty) {
    static constexpr struct {
        std::size_t rows;
        std::array<int, kMostRows> by;
    } kShapes[] = {{1, {1, 0}}, {2, {1, 1}}, {2, {1, -1}}};
    if (penalty != swept_with_) std::fill(open_.begin(), open_.end(), true);
    swept_with_ = penalty;
    bool moved = false;
    for (std::size_t j = std::max<std::size_t>(begin, problem_->first_fixed); j < end; ++j) {
        if (!open_[j]) continue;
        open_[j] = false;
        for (int k = static_cast<int>(problem_->mode_rows.cols()) - 1; k >= 0; --k) {
            for (const auto& shape : kShapes) {
                if (j + shape.rows > end) break;
                for (const int by : {-1, 1}) {
                    while (tried({j, shape.rows, shape.by, k, by, 0, 0}, penalty)) moved = true;
                }
            }
        }
    }
    return moved;
}

bool StreamDescent::sweep_excess(std::size_t begin, std::size_t end) {
    bool moved = false;
    for (std::size_t j = begin; j < end; ++j) {
        if (touches_excess(j)) moved |= sweep_pairs(j, j + 1, kHardPenalty);
    }
    settle(begin, end, kHardPenalty, 4);
    return moved;
}

void StreamDescent::unblock(std::size_t begin, std::size_t end, int most) {
    for (int i = 0; i < most && !within(); ++i) {
        if (!sweep_excess(begin, end)) return;
    }
}

void StreamDescent::insist(std::size_t begin, std::size_t end, int most) {
    for (int i = 0; i < most && !within(); ++i) {
        weight_ = (error_ > kBoundLimit).select(2 * weight_, weight_);
        std::fill(open_.begin(), open_.end(), true);
        sweep_excess(begin, end);
    }
    weight_.setOnes();
}

bool StreamDescent::touches_excess(std::size_t j) const {
    for (Index f = from_[j]; f < to_[j]; ++f) {
        if (error_[f] > kBoundLimit && response_(f, static_cast<Index>(j)) > kTouching) return true;
    }
    return false;
}

bool StreamDescent::sweep_pairs(std::size_t begin, std::size_t end, double penalty) {
    bool moved = false;
    const int n = static_cast<int>(problem_->mode_rows.cols());
    for (std::size_t j = std::max<std::size_t>(begin, problem_->first_fixed); j < end; ++j)
        for (int k = 0; k < n; ++k)
            for (int l = k + 1; l < n; ++l)
                for (const int a : {-1, 1})
                    for (const int b : {-1, 1}) moved |= tried({j, 1, {1, 0}, k, a, l, b}, penalty);
    return moved;
}

bool StreamDescent::allowed(const Change& change) const {
    for (std::size_t i = 0; i < change.rows; ++i) {
        const ViaValues& row = values_[change.first + i];
        if (std::abs(row[static_cast<std::size_t>(change.k)]) > kLargestValue ||
            std::abs(row[static_cast<std::size_t>(change.other_k)]) > kLargestValue)
            return false;
    }
    return true;
}

void StreamDescent::add(const Change& change, int sign) {
    for (std::size_t i = 0; i < change.rows; ++i) {
        ViaValues& row = values_[change.first + i];
        row[static_cast<std::size_t>(change.k)] += sign * change.row_by[i] * change.by;
        if (change.other_by != 0)
            row[static_cast<std::size_t>(change.other_k)] += sign * change.row_by[i] * change.other_by;
    }
}

// Row n's sums after the change, if its class stays.
void StreamDescent::add_to_sums(const Change& change, std::size_t n) {
    Row& row = rows_[n];
    const auto each = [&](std::size_t at, auto&& follow) {
        if (at < change.first || at >= change.first + change.rows) return;
        const int by = change.row_by[at - change.first];
        follow(change.k, by * change.by);
        if (change.other_by != 0) follow(change.other_k, by * change.other_by);
    };
    const StreamCost& cost = problem_->cost;
    each(n, [&](int k, int by) { cost.add_now(row.row_class, k, by, row.sums); });
    if (n == 0) return;
    each(n - 1, [&](int k, int by) { cost.add_last(row.row_class, k, by, row.sums); });
    each(n > 1 ? n - 2 : 0, [&](int k, int by) { cost.add_before(row.row_class, k, by, row.sums); });
}

bool StreamDescent::tried(const Change& change, double penalty) {
    const std::size_t last = std::min(change.first + change.rows + 1, values_.size() - 1);
    const double before = bits(change.first, last + 1);
    if (peeked_excess(change, penalty) > before) return false;  // more than all bits could make up for
    kept_.assign(rows_.begin() + static_cast<std::ptrdiff_t>(change.first),
                 rows_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    add(change, 1);
    for (std::size_t n = change.first; n <= last; ++n) {
        add_to_sums(change, n);
        cost_row(n, false);
    }
    const double needed = before - bits(change.first, last + 1) - kGain;
    if (allowed(change) && excess_change(needed, penalty) < needed) {
        adopt(change);
        return true;
    }
    add(change, -1);
    std::swap_ranges(kept_.begin(), kept_.end(), rows_.begin() + static_cast<std::ptrdiff_t>(change.first));
    return false;
}

void StreamDescent::adopt(const Change& change) {
    const Index n = moved_.size();
    off_.middleCols(moved_from_, n).noalias() += direction_.matrix() * moved_.matrix().transpose();
    error_.segment(moved_from_, n) = fresh_;
    const std::size_t from = change.first > kShared ? change.first - kShared : 0,
                      to = std::min(change.first + change.rows + kShared, open_.size());
    std::fill(open_.begin() + static_cast<std::ptrdiff_t>(from),
              open_.begin() + static_cast<std::ptrdiff_t>(to), true);
}

void StreamDescent::find_response(const Change& change) {
    moved_ = Eigen::ArrayXf::Zero(moved_.size());
    for (std::size_t i = 0; i < change.rows; ++i)
        moved_ +=
            static_cast<float>(change.row_by[i]) *
            response_.col(static_cast<Index>(change.first + i)).segment(moved_from_, moved_.size()).array();
    direction_ = static_cast<float>(change.by) * problem_->mode_rows.col(change.k).array();
    if (change.other_by != 0)
        direction_ += static_cast<float>(change.other_by) * problem_->mode_rows.col(change.other_k).array();
}

// The samples that a change moves, and room for what it makes of them.
void StreamDescent::find_moved(const Change& change) {
    const std::size_t last = change.first + change.rows - 1;
    moved_from_ = std::min(from_[change.first], from_[last]);
    moved_.resize(std::max<Index>(0, std::max(to_[change.first], to_[last]) - moved_from_));
    fresh_.resize(moved_.size());
}

// What becomes of a sample's squared error, i of those moved.
float StreamDescent::error_after(Index i) const {
    const Index p = problem_->points();
    const float a = moved_[i];
    const auto off = off_.col(moved_from_ + i).array();
    return ((off.segment(0, p) + a * direction_.segment(0, p)).square() +
            (off.segment(p, p) + a * direction_.segment(p, p)).square() +
            (off.segment(2 * p, p) + a * direction_.segment(2 * p, p)).square())
        .maxCoeff();
}

// At least so much is the change of penalty * excess, by the sample that is moved most.
double StreamDescent::peeked_excess(const Change& change, double penalty) {
    find_moved(change);
    const Index n = moved_.size();
    if (n == 0) return 0;
    find_response(change);
    Index most = 0;
    moved_.abs().maxCoeff(&most);
    const auto weight = weight_.segment(moved_from_, n);
    const double left =
        (weight * (error_.segment(moved_from_, n) - kBoundLimit).max(0.0f)).cast<double>().sum();
    return penalty * (weight[most] * std::max(0.0f, error_after(most) - kBoundLimit) - left);
}

// The change of penalty * excess by the change that was peeked at; stops once it must be over `most`.
double StreamDescent::excess_change(double most, double penalty) {
    const Index n = moved_.size();
    // the excess now is what may at most be won
    const auto weight = weight_.segment(moved_from_, n);
    double left = (weight * (error_.segment(moved_from_, n) - kBoundLimit).max(0.0f)).cast<double>().sum();
    double changed = 0;
    if (-penalty * left > most) return -penalty * left;
    for (Index step = 0; step < n; ++step) {  // from the middle outwards: there it moves most
        const Index i = n / 2 + (step % 2 == 0 ? step / 2 : -(step + 1) / 2);
        const float was = error_[moved_from_ + i];
        fresh_[i] = error_after(i);
        const double over = weight[i] * std::max(0.0f, was - kBoundLimit),
                     now = weight[i] * std::max(0.0f, fresh_[i] - kBoundLimit);
        changed += penalty * (now - over);
        left -= over;
        if (changed - penalty * left > most) return changed - penalty * left;
    }
    return changed;
}

}  // namespace viaface
