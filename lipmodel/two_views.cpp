#include "lipmodel/two_views.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace viaface {

Eigen::Vector2d projected(const Projection& view, const Eigen::Vector3d& place) {
    return (view * place.homogeneous()).hnormalized();
}

Triangulated triangulate(const Projection& first, const Eigen::Vector2d& in_first, const Projection& second,
                         const Eigen::Vector2d& in_second) {
    Eigen::Matrix4d a;
    a.row(0) = in_first.x() * first.row(2) - first.row(0);
    a.row(1) = in_first.y() * first.row(2) - first.row(1);
    a.row(2) = in_second.x() * second.row(2) - second.row(0);
    a.row(3) = in_second.y() * second.row(2) - second.row(1);
    for (int i = 0; i < 4; ++i) a.row(i) /= a.row(i).head<3>().norm();  // distances in mm
    const auto [u, s, v] = thin_svd(a.leftCols<3>());
    constexpr double kLeastAngle = 1e-4;  // radians between the rays
    if (!(s[2] > kLeastAngle)) throw std::runtime_error("triangulate: the two rays do not meet in one place");
    const Eigen::Vector3d place = -v * (u.transpose() * a.col(3)).cwiseQuotient(s);
    const double squares = (projected(first, place) - in_first).squaredNorm() +
                           (projected(second, place) - in_second).squaredNorm();
    return {place, std::sqrt(squares / 2)};
}

}  // namespace viaface
