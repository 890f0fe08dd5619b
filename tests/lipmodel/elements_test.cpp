// Laws of the elements: null space, patch test, energy and force.
#include "lipmodel/elements.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <iostream>

#include "base/decompositions.hpp"
#include "lipmodel/lip_mesh.hpp"
#include "mouths.hpp"

namespace viaface {
namespace {

Eigen::MatrixXd free_stiffness(const Nodes& nodes, const LipMesh& mesh) {
    return assemble(nodes, mesh.triangles, mesh.stiffness);
}

int null_modes(const Eigen::MatrixXd& stiffness) {
    const Eigen::VectorXd values = symmetric_eigen(stiffness).values;
    return static_cast<int>((values.array().abs() < 1e-9 * values.maxCoeff()).count());
}

// A turn by one radian, linear: omega x (place - centre).
Eigen::VectorXd turn(const Nodes& nodes, int axis) {
    const Eigen::RowVector3d centre = nodes.colwise().mean();
    Nodes moved(nodes.rows(), 3);
    for (Eigen::Index i = 0; i < nodes.rows(); ++i)
        moved.row(i) = Eigen::Vector3d::Unit(axis).cross((nodes.row(i) - centre).transpose());
    return as_column(moved);
}

Eigen::VectorXd shift(const Nodes& nodes, int axis) {
    return as_column(Eigen::RowVector3d::Unit(axis).replicate(nodes.rows(), 1));
}

double energy(const Eigen::MatrixXd& k, const Eigen::VectorXd& u) { return 0.5 * u.dot(k * u); }

TEST(Elements, TheFreeCurvedMeshMovesWithoutForceAlongTranslationsOnly) {
    const LipMesh mesh = generic_lip_mesh();
    const Eigen::MatrixXd k = free_stiffness(mesh.nodes, mesh);
    EXPECT_EQ(null_modes(k), 3);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT((k * shift(mesh.nodes, axis)).cwiseAbs().maxCoeff(), 1e-10);
        const double turned = energy(k, turn(mesh.nodes, axis));
        std::cout << "strain energy of a unit turn about "
                  << "xyz"[axis] << ": " << turned << "\n";
        EXPECT_GT(turned, 1.0);
    }
}

TEST(Elements, AFlatMeshAlsoTurnsInItsPlane) {
    const LipMesh mesh = generic_lip_mesh();
    Nodes flat = mesh.nodes;
    flat.col(2).setZero();
    for (int depth = 1; depth <= LipMesh::kStripDepth; ++depth) {  // the strip, laid out upwards
        for (int across = -1; across <= 1; ++across) flat(LipMesh::strip_node(depth, across), 1) += 6 * depth;
    }
    const Eigen::MatrixXd k = free_stiffness(flat, mesh);
    EXPECT_EQ(null_modes(k), 4);
    EXPECT_LT(energy(k, turn(flat, 2)), 1e-9);
    for (int axis = 0; axis < 2; ++axis) {
        const double turned = energy(k, turn(flat, axis));
        std::cout << "strain energy of a unit turn of the flat mesh about "
                  << "xy"[axis] << ": " << turned << "\n";
        EXPECT_GT(turned, 1.0);
    }
}

// An uneven patch of five nodes in a square, in the plane through the origin with the given frame.
struct Patch {
    Nodes nodes;
    std::vector<Triangle> triangles;
};
Patch patch(const Eigen::Matrix3d& frame) {
    Patch made;
    made.nodes.resize(6, 3);
    made.nodes << 0, 0, 0, 5, 0, 0, 6, 4, 0, -1, 5, 0, 2.1, 1.3, 0, 2.9, 2.6, 0;
    made.nodes = (made.nodes * frame).eval();
    made.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {3, 0, 4}};
    return made;
}

TEST(Elements, ThePatchTestInPlane) {
    Eigen::Matrix3d frame = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()) *
                             Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
    const Patch p = patch(frame);
    const Eigen::MatrixXd k = assemble(p.nodes, p.triangles, std::vector<double>(6, 1.0));
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  // of displacement, in the patch's own plane
    gradient.topLeftCorner<2, 2>() << 0.03, 0.01, -0.02, 0.05;
    const Nodes linear = (p.nodes * frame.transpose()) * gradient.transpose() * frame;
    const Eigen::VectorXd exact = as_column(linear);
    // the inner nodes 4 and 5 find their places by themselves
    const Eigen::VectorXd inner = solve_positive(
        k.bottomRightCorner(6, 6), Eigen::VectorXd(-k.bottomLeftCorner(6, 12) * exact.head(12)));
    EXPECT_LT((inner - exact.tail(6)).cwiseAbs().maxCoeff(), 1e-12);
    // and the energy is that of one constant strain over the whole area
    const Eigen::Vector3d strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
    const double area = 0.5 * (5 * 4 - 0 * 6 + 6 * 5 + 1 * 4);  // shoelace over nodes 0 to 3
    EXPECT_NEAR(energy(k, exact), 0.5 * area * strain.dot(plane_strain({}) * strain), 1e-12);
}

// Energy from the strains themselves, by another way than K: lengths of edges give the strains in plane.
double energy_of_strains(const Corners& c, const Eigen::Matrix<double, 9, 1>& u,
                         const Elasticity& elasticity) {
    const Eigen::Matrix3d frame = element_frame(c);
    Eigen::Matrix3d edges;            // strain along an edge: (a^2, b^2, a b) . (ex, ey, gxy)
    Eigen::Vector3d stretch, across;  // relative, to first order
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const Eigen::Vector3d edge = c[j] - c[i], local = frame * edge.normalized();
        edges.row(i) << local.x() * local.x(), local.y() * local.y(), local.x() * local.y();
        stretch[i] = edge.dot(u.segment<3>(3 * j) - u.segment<3>(3 * i)) / edge.squaredNorm();
        across[i] = frame.row(2).dot(u.segment<3>(3 * i));
    }
    const Eigen::Vector3d strain = edges.fullPivLu().solve(stretch);
    const double area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    const double uneven = (across.array() - across.mean()).square().sum();
    const double stiff = plane_strain(elasticity)(0, 0);
    return 0.5 * area * strain.dot(plane_strain(elasticity) * strain) + 0.5 * stiff * 1.5 * uneven;
}

TEST(Elements, ForceIsTheGradientOfEnergy) {
    test::Noise noise(5);
    const Corners corners = {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 2.5, 2), Eigen::Vector3d(2, 5, 4)};
    for (const Elasticity elasticity : {Elasticity{}, Elasticity{2.0, 0.3}}) {
        const ElementStiffness k = element_stiffness(corners, elasticity);
        const Eigen::Matrix<double, 9, 1> u = noise.matrix(9, 1), force = k * u;
        EXPECT_NEAR(u.dot(force) / 2, energy_of_strains(corners, u, elasticity), 1e-12 * k.norm());
        for (int i = 0; i < 9; ++i) {
            constexpr double kStep = 1e-4;  // the energy is quadratic: central differences are exact
            const Eigen::Matrix<double, 9, 1> step = kStep * Eigen::Matrix<double, 9, 1>::Unit(i);
            const double slope = (energy_of_strains(corners, u + step, elasticity) -
                                  energy_of_strains(corners, u - step, elasticity)) /
                                 (2 * kStep);
            EXPECT_NEAR(slope, force[i], 1e-9 * k.norm());
        }
    }
}

TEST(Elements, OutOfPlaneIsTheMatrixOfThePaper) {
    const Corners flat = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(1, 2, 0)};
    const ElementStiffness k = element_stiffness(flat, {.modulus = 2, .poisson = 0.01});
    const double factor = 2 * 0.99 / (1.01 * 0.98);
    EXPECT_NEAR(k(2, 2), factor, 1e-12);
    EXPECT_NEAR(k(2, 5), -0.5 * factor, 1e-12);
    EXPECT_NEAR(k(8, 8), factor, 1e-12);
    EXPECT_EQ(k(2, 0), 0);  // uncoupled
}

TEST(Elements, SizeDoesNotChangeStiffness) {
    const LipMesh mesh = generic_lip_mesh();
    const Eigen::MatrixXd small = free_stiffness(mesh.nodes, mesh),
                          large = free_stiffness(3 * mesh.nodes, mesh);
    EXPECT_LT((small - large).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Elements, RefuseWhatIsNoMesh) {
    Nodes line(3, 3);
    line << 0, 0, 0, 1, 0, 0, 2, 0, 0;
    EXPECT_THROW(assemble(line, {{0, 1, 2}}, {1.0}), std::invalid_argument);
    EXPECT_THROW(assemble(line, {{0, 1, 3}}, {1.0}), std::invalid_argument);
    EXPECT_THROW(assemble(line, {{0, 1, 2}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
