#include "base/decompositions.hpp"

#include <Eigen/Dense>
#include <stdexcept>

namespace viaface {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
    if (solver.info() != Eigen::Success) throw std::runtime_error("symmetric_eigen: it did not converge");
    return {solver.eigenvalues(), solver.eigenvectors()};
}

ThinQr thin_qr(const Eigen::MatrixXd& tall) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(tall);
    return {qr.householderQ() * Eigen::MatrixXd::Identity(tall.rows(), tall.cols()),
            qr.matrixQR().topRows(tall.cols()).triangularView<Eigen::Upper>()};
}

ThinSvd thin_svd(const Eigen::MatrixXd& matrix) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.completeOrthogonalDecomposition().solve(b);
}
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    return a.completeOrthogonalDecomposition().solve(b);
}
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
    return a.completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::MatrixXd solve_positive(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.ldlt().solve(b);
}
Eigen::VectorXd solve_positive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    return a.ldlt().solve(b);
}

}  // namespace viaface
