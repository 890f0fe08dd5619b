#include "lipmodel/elements.hpp"

#include <Eigen/Geometry>
#include <stdexcept>

namespace viaface {
namespace {

using Strain = Eigen::Matrix<double, 3, 6>;  // B of eq. 27, for u1 v1 u2 v2 u3 v3 (eq. 36)

double constrained_modulus(const Elasticity& elasticity) {
    const double v = elasticity.poisson;
    return elasticity.modulus * (1 - v) / ((1 + v) * (1 - 2 * v));
}

// Corners in the plane of the element: columns are corners.
Eigen::Matrix<double, 2, 3> flattened(const Corners& corners, const Eigen::Matrix3d& frame) {
    Eigen::Matrix<double, 2, 3> flat;
    for (int i = 0; i < 3; ++i) flat.col(i) = (frame * (corners[i] - corners[0])).head<2>();
    return flat;
}

double area_of(const Corners& corners) {
    return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

Strain strain_of(const Eigen::Matrix<double, 2, 3>& flat, double area) {
    Strain b = Strain::Zero();
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d across = flat.col((i + 1) % 3) - flat.col((i + 2) % 3);
        const double dx = across.y() / (2 * area), dy = -across.x() / (2 * area);
        b(0, 2 * i) = dx;
        b(1, 2 * i + 1) = dy;
        b(2, 2 * i) = dy;
        b(2, 2 * i + 1) = dx;
    }
    return b;
}

// k_e in the element's own frame, eq. 34, rows and columns as x y z of each corner.
ElementStiffness local_stiffness(const Eigen::Matrix<double, 6, 6>& in_plane, const Eigen::Matrix3d& across) {
    ElementStiffness k = ElementStiffness::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            k.block<2, 2>(3 * i, 3 * j) = in_plane.block<2, 2>(2 * i, 2 * j);
            k(3 * i + 2, 3 * j + 2) = across(i, j);
        }
    }
    return k;
}

Corners corners_of(const Nodes& nodes, const Triangle& triangle) {
    Corners corners;
    for (int i = 0; i < 3; ++i) {
        if (triangle[i] < 0 || triangle[i] >= nodes.rows())
            throw std::invalid_argument("assemble: a triangle has a corner that is no node");
        corners[i] = nodes.row(triangle[i]);
    }
    return corners;
}

}  // namespace

Eigen::Matrix3d plane_strain(const Elasticity& elasticity) {
    const double v = elasticity.poisson;
    Eigen::Matrix3d c;
    c << 1, v / (1 - v), 0, v / (1 - v), 1, 0, 0, 0, (1 - 2 * v) / (2 * (1 - v));
    return constrained_modulus(elasticity) * c;
}

Eigen::Matrix3d out_of_plane(const Elasticity& elasticity) {
    Eigen::Matrix3d k;
    k << 1, -0.5, -0.5, -0.5, 1, -0.5, -0.5, -0.5, 1;
    return constrained_modulus(elasticity) * k;
}

Eigen::Matrix3d element_frame(const Corners& corners) {
    const Eigen::Vector3d along = corners[1] - corners[0];
    const Eigen::Vector3d normal = along.cross(corners[2] - corners[0]);
    if (!(normal.norm() > 1e-12 * along.squaredNorm()))
        throw std::invalid_argument("element_frame: a triangle without area");
    Eigen::Matrix3d frame;
    frame.row(0) = along.normalized();
    frame.row(2) = normal.normalized();
    frame.row(1) = frame.row(2).cross(frame.row(0));
    return frame;
}

ElementStiffness element_stiffness(const Corners& corners, const Elasticity& elasticity) {
    const Eigen::Matrix3d frame = element_frame(corners);
    const double area = area_of(corners);
    const Strain b = strain_of(flattened(corners, frame), area);
    const ElementStiffness local =
        local_stiffness(area * b.transpose() * plane_strain(elasticity) * b, out_of_plane(elasticity));
    ElementStiffness turn = ElementStiffness::Zero();  // T, eq. 31
    for (int i = 0; i < 3; ++i) turn.block<3, 3>(3 * i, 3 * i) = frame;
    return turn.transpose() * local * turn;
}

Eigen::SparseMatrix<double> assemble(const Nodes& nodes, const std::vector<Triangle>& triangles,
                                     const std::vector<double>& modulus) {
    if (triangles.size() != modulus.size())
        throw std::invalid_argument("assemble: triangles and moduli differ in number");
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(81 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const ElementStiffness k =
            element_stiffness(corners_of(nodes, triangles[t]), {.modulus = modulus[t]});
        for (int i = 0; i < 9; ++i) {
            for (int j = 0; j < 9; ++j)
                entries.emplace_back(3 * triangles[t][i / 3] + i % 3, 3 * triangles[t][j / 3] + j % 3,
                                     k(i, j));
        }
    }
    Eigen::SparseMatrix<double> stiffness(nodes.size(), nodes.size());
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return stiffness;
}

}  // namespace viaface
