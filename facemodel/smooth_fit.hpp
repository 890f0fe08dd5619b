// Nodes of a known mesh pulled to a scanned surface with regularised smoothness: displacements d from the
// start minimise
//     sum_i a_i w_i |x_i + d_i - q_i|^2 + l^4 integral |laplacian d|^2 + sum over pins of m_j |x_j + d_j -
//     p_j|^2
// with a_i the node's area, w_i how far the scan is trusted there, q_i the foot of x_i + d_i on the tangent
// plane at its nearest place of the scan [after ChenMedioni92], and l in mm the wavelength below which the
// displacement is smooth, falling from stage to stage (as in non-rigid ICP, [Amberg07]). Where the scan ends,
// has a hole, turns away or is too far off, nothing pulls and the displacement is continued smoothly. The
// system is sparse and solved by Cholesky factors; the laplacian is that of cotangents.
#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "facemodel/nearest_surface.hpp"

namespace viaface {

struct Pin {
    int node = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // mm
    double weight = 1;                                // mm^2: as so much area of the scan
};

struct FitStage {
    double wavelength = 10;  // mm
    double reach = 10;       // mm: places farther off do not pull
    int rounds = 3;
};

// Of the edge opposite corner k of t: half the cotangent of the angle there, within bounds.
double cotangent_weight(const Nodes& nodes, const Triangle& t, int k);
// [nodes x nodes], positive semi-definite; and the nodes' areas (a third of the adjoining triangles), mm^2.
Eigen::SparseMatrix<double> cotangent_laplacian(const Nodes& nodes, const std::vector<Triangle>& triangles);
Eigen::VectorXd node_areas(const Nodes& nodes, const std::vector<Triangle>& triangles);

// `wanted` without what is rougher than the wavelength: displacements d minimise
//     sum_i a_i |start_i + d_i - wanted_i|^2 + l^4 integral |laplacian d|^2.
Nodes smoothed(const Nodes& start, const std::vector<Triangle>& triangles, const Nodes& wanted,
               double wavelength);

struct SmoothFit {
    Nodes nodes;                // [nodes x 3], mm
    std::vector<bool> covered;  // [nodes] whether the scan pulled in the last round
};

// trust: [nodes], 0 to 1. begun: where an earlier fit of the same start has come to. Nodes that belong to no
// triangle stay. std::runtime_error when the system cannot be solved.
SmoothFit fit_smoothly(const Nodes& start, const std::vector<Triangle>& triangles, const NearestSurface& scan,
                       const Eigen::VectorXd& trust, const std::vector<Pin>& pins,
                       std::span<const FitStage> stages, const Nodes* begun = nullptr);

}  // namespace viaface
