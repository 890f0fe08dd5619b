// A principal-component basis of configurations: points = mean + modes * components. The number of modes is
// chosen by the largest error in mm at any point of any held-out configuration, not by variance: 99.99% of
// variance can leave 1.7 mm.
//
// Modes are orthonormal, ordered by falling variance of the training, and each has its entry of largest
// magnitude (the first one among equals) positive. Points that the training lacks have a NaN mean and zero
// modes, so that recovered points are NaN there too.
#pragma once

#include <Eigen/Core>

#include "viapoints/motion.hpp"

namespace viaface {

struct ConfigurationBasis {
    Configuration mean;     // [114], mm; NaN where the training has no such point
    Eigen::MatrixXd modes;  // [114 x k], orthonormal columns

    Eigen::Index size() const { return modes.cols(); }
};

// `modes` components of training [configurations x 114], mm, or as many as its rank allows.
// InputError("training", ...) for points with gaps.
ConfigurationBasis principal_basis(const RowMatrix& training, Eigen::Index modes);

// The fewest modes of the training with which each held-out configuration is within max_error_mm at each
// point. InputError("max_error_mm", ...) when all of them do not do.
ConfigurationBasis choose_basis(const RowMatrix& training, const RowMatrix& held_out, double max_error_mm);

// [configurations x 114] to [configurations x k] and back. Points that the basis lacks are left out;
// std::invalid_argument for a configuration that lacks a point which the basis has.
RowMatrix to_components(const ConfigurationBasis& basis, const RowMatrix& points);
RowMatrix to_points(const ConfigurationBasis& basis, const RowMatrix& components);

// The basis's own error: the largest 3-D distance, mm, of any point of any configuration from its image in
// the basis.
double truncation_error_mm(const ConfigurationBasis& basis, const RowMatrix& points);

std::vector<int> points_of(
    const ConfigurationBasis& basis);  // layout indices of the points that it holds, rising

}  // namespace viaface
