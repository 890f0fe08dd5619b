#include "lipmodel/lip_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "lipmodel/elements.hpp"
#include "lipmodel/spread.hpp"

namespace viaface {
namespace {

GroundedBody grounded(const LipMesh& mesh) {
    return GroundedBody(assemble(mesh.nodes, mesh.triangles, mesh.stiffness), held_nodes());
}

struct Box {
    Eigen::RowVector3d centre, size;
};
Box box_of(const MarkedPoints& points) {
    const Eigen::Map<const Eigen::Matrix<double, LipMesh::kMarked, 3, Eigen::RowMajor>> rows(points.data());
    const Eigen::RowVector3d least = rows.colwise().minCoeff(), most = rows.colwise().maxCoeff();
    return {0.5 * (least + most), most - least};
}

Nodes laid_over(const Nodes& generic, const MarkedPoints& rest) {
    const Box from = box_of(marked_of(as_column(generic))), to = box_of(rest);
    if (!(to.size.minCoeff() > 0.5)) throw std::runtime_error("lip_body: the points at rest span no mouth");
    const Eigen::RowVector3d scale = to.size.cwiseQuotient(from.size);
    return (((generic.rowwise() - from.centre).array().rowwise() * scale.array()).matrix().rowwise() +
            to.centre);
}

Eigen::Vector3d normal_of(const Nodes& nodes, const Triangle& t) {
    const Eigen::Vector3d a = nodes.row(t[0]), b = nodes.row(t[1]), c = nodes.row(t[2]);
    return (b - a).cross(c - a);
}

// The inner bands may roll in; skin and the lips' outer band may not.
void refuse_folds(const LipMesh& before, const Nodes& after) {
    constexpr int kRollsIn = LipMesh::node(LipMesh::kBorderRing + 2, 0);
    for (const Triangle& triangle : before.triangles) {
        if (std::ranges::max(triangle) >= kRollsIn) continue;
        if (!(normal_of(before.nodes, triangle).dot(normal_of(after, triangle)) > 0))
            throw std::runtime_error("lip_body: the points at rest fold the mesh over itself");
    }
}

}  // namespace

LipBody lip_body(const MarkedPoints& rest) {
    LipMesh mesh = generic_lip_mesh();
    mesh.nodes = laid_over(mesh.nodes, rest);
    const auto marked = marked_nodes();
    const Eigen::VectorXd start = as_column(mesh.nodes);
    const Eigen::VectorXd moved =
        start + least_force_spread(grounded(mesh), marked) * (rest - marked_of(start));
    refuse_folds(mesh, as_lip_nodes(moved));
    mesh.nodes = as_lip_nodes(moved);
    Eigen::MatrixXd spread = least_force_spread(grounded(mesh), marked);
    return {std::move(mesh), std::move(spread)};
}

double lip_opening(const MarkedPoints& points) {
    constexpr int kInner = LipMesh::kMarked / 2;  // top, top left, left, bottom left, bottom, ...
    double sum = 0;
    for (const auto& [upper, lower] : {std::pair{0, 4}, {1, 3}, {7, 5}})
        sum += (points.segment<3>(3 * (kInner + upper)) - points.segment<3>(3 * (kInner + lower))).norm();
    return sum / 3;
}

Eigen::Index rest_frame(const Eigen::MatrixXd& frames) {
    if (frames.cols() == 0 || frames.rows() != LipMesh::kMarkedCoordinates)
        throw std::invalid_argument("rest_frame: no frames of sixteen points");
    std::vector<Eigen::Index> order(frames.cols());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::vector<double> opening(frames.cols());
    for (const Eigen::Index i : order) opening[i] = lip_opening(frames.col(i));
    std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return opening[i]; });
    order.resize((order.size() + 9) / 10);
    const Eigen::VectorXd mean = frames(Eigen::all, order).rowwise().mean();
    return *std::ranges::min_element(order, {},
                                     [&](Eigen::Index i) { return (frames.col(i) - mean).norm(); });
}

}  // namespace viaface
