// What the search for a segment's via points must follow, in the units it works in: lengths in bounds, values
// in steps, points as all x, all y, all z, so that distances of all points are found side by side.
#pragma once

#include "viapoints/stream_cost.hpp"
#include "viapoints/stream_search.hpp"

namespace viaface {

struct SearchProblem {
    std::vector<double> tick;   // of the samples
    Eigen::MatrixXf mode_rows;  // [3 points x k], times step / bound
    Eigen::MatrixXf wanted;     // [3 points x samples], / bound
    RowMatrix components;       // [samples x k], mm
    const StreamCost& cost;
    double step;  // mm
    bool first_fixed;

    Eigen::Index points() const { return wanted.rows() / 3; }
};

SearchProblem problem_of(const SegmentTarget& target, const Eigen::MatrixXd& modes, const StreamCost& cost,
                         const SearchOptions& options, bool first_fixed);

// Via points [first, last), and the samples that those in [begin, end) move. Margins to either side of these
// make their B-splines whole.
struct SearchWindow {
    std::size_t first, last, begin, end;
};
SearchWindow window_around(const std::vector<int>& ticks, std::size_t j, bool first_fixed);
SearchProblem part_of(const SearchProblem& problem, const std::vector<int>& ticks,
                      const SearchWindow& window);

// Values by least squares, rounded; the first ones are `first` unless it is empty.
std::vector<ViaValues> fitted(const SearchProblem& problem, const std::vector<int>& ticks,
                              const ViaValues& first);
// Those of via points [begin, end) fitted again, the others as they are.
void fit_between(const SearchProblem& problem, const std::vector<int>& ticks, std::vector<ViaValues>& values,
                 std::size_t begin, std::size_t end);

// Whether even free control values at every tick leave far more than the bound.
bool hopeless(const SearchProblem& problem, const std::vector<int>& ticks);

// The via points that are not of the ends: [inner_begin, inner_end).
std::size_t inner_begin(const std::vector<int>& ticks);
std::size_t inner_end(const std::vector<int>& ticks);

}  // namespace viaface
