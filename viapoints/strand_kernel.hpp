// The arithmetic of the strands' fit (strand_fit.hpp), four strands side by side: plain arrays, as the
// kernels are compiled once per instruction set and may share no inline function with the rest of the
// program. Only operations that IEEE 754 fixes to the last bit: every instruction set gives the same bytes.
#pragma once

#include <cstddef>

#include "viapoints/quintic_rows.hpp"

namespace viaface {

inline constexpr int kLanes = 4;

struct alignas(32) Lanes {
    double lane[kLanes];  // one to a strand, or components of a basis
};

// Samples in a row, and the control points that may change for them.
struct FitRows {
    const QuinticRow* rows;
    const std::ptrdiff_t* starts;  // [runs + 1]: rows from one to the next name the same control points
    std::ptrdiff_t runs;
    int controls;  // in all; rows may name kSupport - 1 beyond, whose weights are zero
    int free_begin, free_end;
};

struct Misses {
    Lanes largest, weighted, emphasis;  // the largest, and the sums of emphasis * miss and of emphasis
};

struct StrandKernel {
    // Of samples that weigh `emphasis` each: the band of their normal equations [controls + 5 x 6], its upper
    // half, and its factors [free x 6]: Cholesky's without roots, the inverse of the diagonal first.
    void (*factor)(const FitRows&, const Lanes* emphasis, Lanes* band, Lanes* factors);
    // From values [samples x vectors] to the free ones of the control points [controls + 5 x vectors].
    void (*solve)(const FitRows&, const Lanes* band, const Lanes* factors, const Lanes* emphasis, int vectors,
                  const Lanes* value, Lanes* right, Lanes* control);
    // Values less the spline [samples x vectors].
    void (*leave)(const FitRows&, int vectors, const Lanes* value, const Lanes* control, Lanes* left);
    // The squares of that, summed over vectors [samples].
    void (*miss)(const FitRows&, int vectors, const Lanes* value, const Lanes* control, Lanes* miss);
    Misses (*judge)(std::ptrdiff_t samples, const Lanes* emphasis, const Lanes* miss);
    // Weights in proportion to distances, with a mean of one; those of lanes whose largest miss is given as 0
    // stay as they are.
    void (*emphasise)(std::ptrdiff_t samples, const Lanes* miss, const Lanes* largest, Lanes* emphasis);
    bool (*even)(std::ptrdiff_t samples, const Lanes* emphasis);  // whether all weigh 1
    // The sum of the fourth powers of miss / limit.
    double (*strain)(std::ptrdiff_t samples, const Lanes* miss, double limit);
    // The square of the jump of control points [7][vectors], given its weights.
    double (*jump)(const double* weights, const Lanes* const* control, int vectors);
};

const StrandKernel& baseline_kernel();
const StrandKernel& best_kernel();  // the widest that this processor has

}  // namespace viaface
