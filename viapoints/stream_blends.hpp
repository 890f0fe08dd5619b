// Blends: modes that a stream makes of a model's modes by a few rough weights, so that directions of its own
// cost bytes, not a mode's 342 numbers:
//   blend_b = sum over i of weight_ib mode_i,
// each weight one of 0, 1/7, 2/7, 4/7 and 1, either way.
#pragma once

#include <array>

#include "base/bytes.hpp"
#include "viapoints/basis.hpp"

namespace viaface {

inline constexpr std::array<double, 5> kBlendSizes = {0, 1 / 7.0, 2 / 7.0, 4 / 7.0, 1};
inline constexpr int kLargestBlend = kBlendSizes.size() - 1;

// [model's modes, or its first ones, x blends]: indices into kBlendSizes, negative ones for negative weights
using BlendWeights = Eigen::MatrixXi;

// [114 x blends]
Eigen::MatrixXd blended_modes(const ConfigurationBasis& basis, const BlendWeights& weights);

// Range-coded; weights of `shared` modes (rising) are 0 and not told.
void put_blends(ByteWriter& writer, const BlendWeights& weights, const std::vector<int>& shared);
BlendWeights take_blends(ByteReader& reader, const std::vector<int>& shared);

// Blends that with the modes `shared` of the basis leave at most max_error_mm at `points`, or as many as its
// other modes allow.
BlendWeights needed_blends(const ConfigurationBasis& basis, const std::vector<int>& shared,
                           const std::vector<int>& points, const RowMatrix& positions, double max_error_mm);

}  // namespace viaface
