// Thin-shell elements: a triangle stretches in its plane and resists uneven shifts out of it, the two
// uncoupled. [Basu98, Appendix A, eqs. 26-38]
//   k_xy = A B^t C B  (eqs. 28, 35-37; strains constant over a linear triangle, thickness 1),
//   k_z  = E (1 - v) / ((1 + v)(1 - 2v)) [1 -1/2 -1/2; -1/2 1 -1/2; -1/2 -1/2 1]  (eq. 38),
//   k_e' = T^t k_e T  (eqs. 30-32),   K u = f  (eq. 33).
// The paper calls eq. 37 plane stress; it is the matrix of plane strain, and ours is what eq. 37 says.
// Both parts are unchanged when the mesh is scaled as a whole. k_z resists every turn of a curved mesh, so
// the free mesh moves without force along the three translations only.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

struct Elasticity {
    double modulus = 1;     // E, eq. 37
    double poisson = 0.01;  // v, eq. 37: in [0, 0.5)
};

using Corners = std::array<Eigen::Vector3d, 3>;
using ElementStiffness = Eigen::Matrix<double, 9, 9>;  // x y z of each corner in turn

Eigen::Matrix3d plane_strain(const Elasticity& elasticity);  // C, eq. 37
Eigen::Matrix3d out_of_plane(const Elasticity& elasticity);  // k_z, eq. 38
Eigen::Matrix3d element_frame(const Corners& corners);       // lambda, eq. 30; k is the normal
ElementStiffness element_stiffness(const Corners& corners, const Elasticity& elasticity);  // k_e', eq. 32

// K [3 nodes x 3 nodes], eq. 33; `modulus` of each triangle. std::invalid_argument for a triangle without
// area, an index without a node, or numbers of triangles and moduli that differ.
Eigen::SparseMatrix<double> assemble(const Nodes& nodes, const std::vector<Triangle>& triangles,
                                     const std::vector<double>& modulus);

}  // namespace viaface
