// Directions: modes that a stream has of its own within what its model's modes span, for motion that goes
// other ways than what the model was learned from:
//   direction_d = sum over i of weight_id 2^shift_d / 1024 mode_i.
// The first ones, along which a motion goes far, have fine weights, the others rough ones.
#pragma once

#include "base/bytes.hpp"
#include "viapoints/basis.hpp"
#include "viapoints/stream_statistics.hpp"

namespace viaface {

inline constexpr int kMostShift = 10;

struct StreamDirections {
    Eigen::MatrixXi weights;           // [model's modes, or its first ones, x directions], -1024 to 1024
    std::vector<int> shift;            // one each, 0 to 10
    std::vector<std::uint8_t> chance;  // in 1/256: how often a value is not as predicted, at first

    Eigen::Index count() const { return weights.cols(); }
};

// [114 x directions]
Eigen::MatrixXd modes_along(const ConfigurationBasis& basis, const StreamDirections& directions);

// Range-coded; std::runtime_error for what cannot be.
void put_directions(ByteWriter& writer, const StreamDirections& directions);
StreamDirections take_directions(ByteReader& reader);

// The principal directions of the positions within the basis that leave at most max_error_mm at `points`, or
// as many as it spans there.
StreamDirections needed_directions(const ConfigurationBasis& basis, const std::vector<int>& points,
                                   const RowMatrix& positions, double max_error_mm);

// `statistics` from component `first` on, one for each direction.
void set_chances(StreamStatistics& statistics, std::size_t first, const std::vector<std::uint8_t>& chance);

}  // namespace viaface
