// What one mesh does, done by another of the same topology. [SumnerPopovic04] In the form of [Botsch06]: of
// every source triangle the affine map S from rest to pose (its third axis the normal); the target's edges
// want to be S times their rest, which is a Poisson equation with the target's cotangents: one sparse system,
// factored once for all poses. Nodes that never move stay.
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

class DeformationTransfer {
  public:
    // still: [nodes] held where they rest. std::invalid_argument when shapes differ or nothing is still.
    DeformationTransfer(Nodes source_rest, Nodes target_rest, std::vector<Triangle> triangles,
                        const std::vector<bool>& still);

    Nodes operator()(const Nodes& source_pose) const;  // [nodes x 3]: the target's pose

  private:
    Nodes source_, target_;
    std::vector<Triangle> triangles_;
    std::vector<Eigen::Matrix3d> from_rest_;  // [triangles]: inverse of the source's frame
    Eigen::SparseMatrix<double> hold_;        // [nodes x nodes], diagonal
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace viaface
