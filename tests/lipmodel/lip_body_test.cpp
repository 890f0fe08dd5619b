// Laws of the body that points move: they get where they should, by the least of what is minimised.
#include "lipmodel/lip_body.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "lipmodel/elements.hpp"
#include "lipmodel/spread.hpp"
#include "mouths.hpp"

namespace viaface {
namespace {

struct Bench {
    LipMesh mesh = generic_lip_mesh();
    Eigen::SparseMatrix<double> stiffness = assemble(mesh.nodes, mesh.triangles, mesh.stiffness);
    GroundedBody body{stiffness, held_nodes()};
    Eigen::MatrixXd by_force = least_force_spread(body, marked_nodes());
    Eigen::MatrixXd by_energy = least_energy_spread(body, marked_nodes());
};
const Bench& bench() {
    static const Bench made;
    return made;
}

Eigen::VectorXd held_to_zero(Eigen::VectorXd u) {
    for (const int node : held_nodes()) u.segment<3>(3 * node).setZero();
    return u;
}

// The forces on the free nodes that hold a displacement.
Eigen::VectorXd forces(const Eigen::VectorXd& u) { return held_to_zero(bench().stiffness * u); }

TEST(GroundedBody, DisplacementsAnswerForces) {
    test::Noise noise(1);
    const Eigen::VectorXd f = held_to_zero(noise.matrix(LipMesh::kFreedoms, 1));
    const Eigen::VectorXd u = bench().body.displacements(f);
    EXPECT_LT((forces(u) - f).cwiseAbs().maxCoeff(), 1e-9);
    for (const int node : held_nodes()) EXPECT_EQ(u.segment<3>(3 * node).norm(), 0);
}

TEST(GroundedBody, RefusesABodyThatIsNotHeld) {
    EXPECT_THROW(GroundedBody(bench().stiffness, {}), std::runtime_error);
}

TEST(Spread, PointsReachTheirGoals) {
    test::Noise noise(2);
    const MarkedPoints goal = 5 * noise.matrix(LipMesh::kMarkedCoordinates, 1);
    EXPECT_LT((marked_of(bench().by_force * goal) - goal).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((marked_of(bench().by_energy * goal) - goal).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Spread, NoOtherWayToTheGoalsNeedsLess) {
    test::Noise noise(3);
    const MarkedPoints goal = 5 * noise.matrix(LipMesh::kMarkedCoordinates, 1);
    const Eigen::VectorXd by_force = bench().by_force * goal, by_energy = bench().by_energy * goal;
    const auto squared_force = [](const Eigen::VectorXd& u) { return forces(u).squaredNorm(); };
    const auto energy = [](const Eigen::VectorXd& u) { return 0.5 * u.dot(bench().stiffness * u); };
    for (int i = 0; i < 20; ++i) {
        Eigen::VectorXd other = held_to_zero(noise.matrix(LipMesh::kFreedoms, 1));
        for (const int node : marked_nodes()) other.segment<3>(3 * node).setZero();
        for (const double size : {0.01, -0.01, 1.0}) {
            EXPECT_GT(squared_force(by_force + size * other), squared_force(by_force));
            EXPECT_GT(energy(by_energy + size * other), energy(by_energy));
        }
    }
    EXPECT_LT(squared_force(by_force), squared_force(by_energy));
    EXPECT_LT(energy(by_energy), energy(by_force));
}

TEST(Spread, LeastForceBesideLeastEnergy) {
    const MarkedPoints rest = test::resting_mouth();
    const LipBody body = lip_body(rest);
    const GroundedBody grounded(assemble(body.mesh.nodes, body.mesh.triangles, body.mesh.stiffness),
                                held_nodes());
    const Eigen::MatrixXd goals = test::speaking_mouth(150).colwise() - rest;
    const Eigen::MatrixXd by_force = body.spread * goals;
    const Eigen::MatrixXd by_energy = least_energy_spread(grounded, marked_nodes()) * goals;
    const double apart = std::sqrt((by_force - by_energy).squaredNorm() / by_force.size());
    const double moved = std::sqrt(by_force.squaredNorm() / by_force.size());
    std::cout << "least f'f and least u'Ku differ by " << apart << " mm rms where displacements are " << moved
              << " mm rms\n";
    EXPECT_GT(apart, 0);
    EXPECT_LT(apart, 0.5 * moved);
}

TEST(Spread, AShiftOfAllPointsShiftsTheLips) {
    MarkedPoints shift;
    for (int i = 0; i < LipMesh::kMarked; ++i) shift.segment<3>(3 * i) = Eigen::Vector3d(1, -2, 0.5);
    const Nodes moved = as_lip_nodes(bench().by_force * shift);
    const auto lips = moved.middleRows(LipMesh::node(LipMesh::kBorderRing, 0), 4 * LipMesh::kColumns);
    // the strip pulls a little: it is soft, not absent
    EXPECT_LT((lips.rowwise() - Eigen::RowVector3d(1, -2, 0.5)).cwiseAbs().maxCoeff(), 0.2);
}

TEST(LipBody, RestsWhereTheTalkerRests) {
    const MarkedPoints rest = test::resting_mouth();
    const LipBody body = lip_body(rest);
    EXPECT_LT((marked_of(as_column(body.mesh.nodes)) - rest).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_EQ(body.spread.rows(), 612);
    EXPECT_EQ(body.spread.cols(), 48);
}

TEST(LipBody, RefusesPointsThatAreNoMouth) {
    EXPECT_THROW(lip_body(MarkedPoints::Zero()), std::runtime_error);
    MarkedPoints inside_out = test::resting_mouth();
    inside_out.head<24>().swap(inside_out.tail<24>());
    EXPECT_THROW(lip_body(inside_out), std::runtime_error);
}

TEST(RestFrame, IsAClosedMouthAmongOthers) {
    const Eigen::MatrixXd frames = test::speaking_mouth(200);
    const Eigen::Index rest = rest_frame(frames);
    int more_closed = 0;
    for (Eigen::Index i = 0; i < frames.cols(); ++i)
        more_closed += lip_opening(frames.col(i)) < lip_opening(frames.col(rest));
    EXPECT_LE(more_closed, 20);
    EXPECT_THROW(rest_frame(Eigen::MatrixXd(48, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace viaface
