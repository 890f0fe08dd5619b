// A body with some of its nodes held: K_s^-1 f_s = u_s [Basu98, eq. 39]. Sparse, factored once, solved often.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <span>

namespace viaface {

// Immutable: safe from any thread.
class GroundedBody {
  public:
    // stiffness: K [freedoms x freedoms]. std::runtime_error when what is left can still move without force.
    GroundedBody(const Eigen::SparseMatrix<double>& stiffness, std::span<const int> held_nodes);

    // Displacements under forces, a case per column; zero at held nodes, where forces do nothing.
    // [freedoms x cases]
    Eigen::MatrixXd displacements(const Eigen::MatrixXd& forces) const;

    Eigen::Index freedoms() const { return freedoms_; }

  private:
    Eigen::Index freedoms_;
    std::vector<Eigen::Index> free_;  // [free freedoms], rising
    std::unique_ptr<const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> factored_;
};

}  // namespace viaface
