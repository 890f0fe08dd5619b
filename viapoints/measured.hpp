// Which points of a recording were measured, and distances between points. A point is measured at every
// sample or at none: a gap is the caller's to fill or cut, and is refused by name.
#pragma once

#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

// Layout indices of the points that positions [samples x 114] hold, rising. InputError(field, ...) for a
// point with a gap or an infinite coordinate, and when no point was measured.
std::vector<int> measured_points(const RowMatrix& positions, const std::string& field);

// The coordinates of the points given, x y z of the first one first: [samples x 3 * points].
RowMatrix coordinates_of(const RowMatrix& positions, const std::vector<int>& points);

// The largest 3-D length among consecutive triples of any row.
double longest_triple(const Eigen::Ref<const RowMatrix>& triples);

}  // namespace viaface
