// Descent over the whole numbers of a segment's via points at given times, in
//   bits + penalty * sum over samples of the squared error of the worst point over the bound:
// one after the other small changes are tried and kept where they lower it. A change moves one or two
// components of one or two neighbouring via points by a step each, together or against each other: a
// value that is predicted from the ones before is cheaper to move with them.
#pragma once

#include <array>

#include "viapoints/stream_problem.hpp"

namespace viaface {

inline constexpr double kSoftPenalty = 60;  // bits per unit of squared error over the bound, at each sample
inline constexpr double kHardPenalty = 1e4;
inline constexpr float kBoundLimit = 0.998f;  // of the bound, squared: what rounding of the search may take

class StreamDescent {
  public:
    StreamDescent(const SearchProblem& problem, std::vector<int> ticks, std::vector<ViaValues> values);

    // Sweeps over via points [begin, end) until nothing moves, at most so many.
    void settle(std::size_t begin, std::size_t end, double penalty, int most);
    // The same with two components at once, where the bound is exceeded, until it is not or nothing helps.
    void unblock(std::size_t begin, std::size_t end, int most);
    // The same again and again, each time with more weight on the samples that still exceed it [Morris93].
    void insist(std::size_t begin, std::size_t end, int most);
    bool sweep_pairs(std::size_t begin, std::size_t end, double penalty);
    void refresh();  // all errors from the values, without what rounding has added up

    double bits(std::size_t begin, std::size_t end) const;
    double bits() const { return bits(0, rows_.size()); }
    double excess() const { return (error_ - kBoundLimit).max(0.0f).cast<double>().sum(); }
    bool within() const { return !(error_ > kBoundLimit).any(); }
    const std::vector<int>& ticks() const { return tick_; }
    const std::vector<ViaValues>& values() const { return values_; }
    float error(std::size_t sample) const { return error_[static_cast<Eigen::Index>(sample)]; }

  private:
    static constexpr std::size_t kMostRows = 2;
    static constexpr std::size_t kShared = 8;  // via points to either side whose samples or costs are shared
    struct Row {                               // what a via point costs, and from what
        int row_class = 0;
        PredictionSums sums;
        double bits = 0;
    };
    struct Change {
        std::size_t first, rows;
        std::array<int, kMostRows> row_by;
        int k, by, other_k, other_by;  // other_by 0: one component
    };

    bool sweep_excess(std::size_t begin, std::size_t end);
    bool sweep(std::size_t begin, std::size_t end, double penalty);
    bool tried(const Change& change, double penalty);
    void adopt(const Change& change);
    bool allowed(const Change& change) const;
    void add(const Change& change, int sign);
    void add_to_sums(const Change& change, std::size_t n);
    void cost_row(std::size_t n, bool anew);
    double gap_bits(std::size_t n) const;
    float error_after(Eigen::Index i) const;
    double peeked_excess(const Change& change, double penalty);
    double excess_change(double most, double penalty);
    void find_moved(const Change& change);
    void find_response(const Change& change);
    bool touches_excess(std::size_t j) const;

    const SearchProblem* problem_;
    std::vector<int> tick_;
    std::vector<ViaValues> values_;
    Eigen::MatrixXf response_;             // [samples x via]
    std::vector<Eigen::Index> from_, to_;  // the samples that a via point moves
    Eigen::MatrixXf off_;                  // [3 points x samples], drawn minus wanted, / bound
    Eigen::ArrayXf error_;                 // the largest squared distance of each sample / bound^2
    Eigen::ArrayXf weight_;                // of each sample's excess
    std::vector<Row> rows_;
    std::vector<bool> open_;  // something near has changed since nothing was won at this via point
    double swept_with_ = 0;   // the penalty then
    std::vector<Row> kept_;   // rows before a change
    Eigen::ArrayXf moved_, direction_, fresh_;  // of a change: samples, coordinates, error
    Eigen::Index moved_from_ = 0;
};

}  // namespace viaface
