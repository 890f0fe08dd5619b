// What else could carry a motion: baselines for the stream, brought to the same measured maximum error by
// search, so that bits are compared and nothing else. All hold principal components, whose basis is not
// counted, as it is not for the stream.
//
// - Block DCT [Ahmed74] of each component with one uniform quantiser, its coefficients coded by the stream's
// own
//   range coder in contexts of component and frequency that were primed on the training motion. The block's
//   length, the number of components and the width of the quantiser's zero are searched.
// - 16-bit differences of the components from sample to sample, quantised evenly, packed by xz.
#pragma once

#include "viapoints/basis.hpp"

namespace viaface {

struct BaselineBits {
    double bits = 0;
    double max_error_mm = 0, rms_error_mm = 0;
    int components = 0;
    int block = 0;  // samples; of the DCT
    double step_mm = 0;
};

// The fewest bits with which every point of every sample of `motion` stays within the bound. Both motions
// have even times and the points of the basis. InputError("max_error_mm", ...) when none does.
BaselineBits dct_bits(const Motion& motion, const Motion& training, const ConfigurationBasis& basis,
                      double bound_mm);
BaselineBits delta_xz_bits(const Motion& motion, const ConfigurationBasis& basis, double bound_mm);

}  // namespace viaface
