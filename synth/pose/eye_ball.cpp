#include "synth/pose/eye_ball.hpp"

#include <Eigen/Dense>
#include <stdexcept>

namespace viaface {

// |p|^2 = 2 p.c + (r^2 - |c|^2), linear in c and the rest.
EyeBall eye_ball_of(const Nodes& eye) {
    const Eigen::RowVector3d apex = eye.row(eye.rows() - 1);
    const double behind = 1.2 * EyeBall::kIrisRadius / EyeBall::kRadius;  // of the radius
    const double radius = (eye.col(0).maxCoeff() - eye.col(0).minCoeff()) / 2;
    std::vector<Eigen::Index> sphere;
    for (Eigen::Index i = 0; i < eye.rows(); ++i) {
        if ((eye.row(i) - apex).head<2>().norm() > behind * radius) sphere.push_back(i);
    }
    if (sphere.size() < 8) throw std::invalid_argument("an eye of too few nodes");
    const Nodes nodes = eye(sphere, Eigen::all);
    Eigen::MatrixXd rows(nodes.rows(), 4);
    rows << 2 * nodes, Eigen::VectorXd::Ones(nodes.rows());
    const Eigen::Vector4d found = rows.colPivHouseholderQr().solve(nodes.rowwise().squaredNorm());
    const auto rounded = [](double mm) { return std::round(100 * mm) / 100; };
    const Eigen::Vector3d centre = found.head<3>();
    const double fitted = rounded(std::sqrt(found[3] + centre.squaredNorm()));
    return {centre.unaryExpr(rounded), fitted / EyeBall::kRadius};
}

}  // namespace viaface
