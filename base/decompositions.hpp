// Decompositions of dense matrices of any size. Eigen's templates of them cost some ten seconds in every file
// that instantiates them; here they are compiled once for all rooms. What Eigen says of each holds.
#pragma once

#include <Eigen/Core>

namespace viaface {

struct SymmetricEigen {
    Eigen::VectorXd values;   // rising
    Eigen::MatrixXd vectors;  // [n x n], a column for each
};
// Throws std::runtime_error where the iteration does not converge.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric);

struct ThinQr {
    Eigen::MatrixXd q;  // [m x n], orthonormal columns
    Eigen::MatrixXd r;  // [n x n], upper triangle
};
ThinQr thin_qr(const Eigen::MatrixXd& tall);

struct ThinSvd {
    Eigen::MatrixXd u;  // [m x min(m, n)]
    Eigen::VectorXd s;  // falling
    Eigen::MatrixXd v;  // [n x min(m, n)]
};
ThinSvd thin_svd(const Eigen::MatrixXd& matrix);

// The shortest x with a x nearest to b, whatever a's rank is.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

// a x = b with a symmetric and positive semidefinite.
Eigen::MatrixXd solve_positive(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::VectorXd solve_positive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace viaface
