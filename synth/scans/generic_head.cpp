#include "synth/scans/generic_head.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/whole_file.hpp"
#include "facemodel/gltf.hpp"
#include "facemodel/lips.hpp"
#include "facemodel/remesh.hpp"

namespace viaface {

Eigen::Vector3d middle_of(const Nodes& nodes, const NodeLoop& loop) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int node : loop) sum += nodes.row(node).transpose();
    return sum / static_cast<double>(loop.size());
}

namespace {

using Eigen::Vector3d;

std::vector<Triangle> welded_surface(const Face& face) {
    std::vector<Triangle> surface;
    for (const FacePart& part : face.parts) {
        if (part.name != "skin" && part.name != "head_back" && part.name != "lips") continue;
        for (Triangle t : part.triangles) {
            for (int& node : t) node = face.weld[static_cast<std::size_t>(node)];
            surface.push_back(t);
        }
    }
    return surface;
}

double extent_of(const Nodes& nodes, const NodeLoop& loop) {
    const Eigen::RowVector3d middle = middle_of(nodes, loop).transpose();
    double sum = 0;
    for (const int node : loop) sum += (nodes.row(node) - middle).head<2>().norm();
    return sum;
}

NodeLoop loop_round(const Face& face, const std::vector<Loop>& loops, const FacePart& eye) {
    const Vector3d middle = face.rest.middleRows(eye.first_node, eye.nodes).colwise().mean();
    const auto nearest = std::ranges::min_element(
        loops, {}, [&](const Loop& loop) { return (middle_of(face.rest, loop) - middle).norm(); });
    if (nearest == loops.end()) throw std::runtime_error("the generic head has no opening for " + eye.name);
    return *nearest;
}

PaintedSurface drawn_part(const Face& face, const FacePart& part) {
    PaintedSurface drawn;
    drawn.mesh.nodes = face.rest;
    drawn.mesh.triangles = part.triangles;
    drawn.mesh.uvs = face.uvs.cast<double>();
    share_uvs_with_nodes(drawn.mesh);
    drawn.picture = face.surfaces[static_cast<std::size_t>(part.material)].base_colour;
    return drawn;
}

double falling(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return 1 - t * t * (3 - 2 * t);
}

}  // namespace

Eigen::VectorXd GenericHead::face_share() const {
    Eigen::VectorXd share(face.rest.rows());
    for (Eigen::Index i = 0; i < share.size(); ++i) {
        const Vector3d p = face.rest.row(i);
        share[i] = falling(58, 72, std::abs(p.x())) * falling(100, 120, p.y()) * falling(52, 64, -p.y()) *
                   falling(55, 75, -p.z());
    }
    return share;
}

Nodes GenericHead::posture(Eigen::Index k) const {
    Nodes nodes = face.rest;
    const Eigen::VectorXd shape = face.mean + face.modes * training.coefficients.col(k);
    for (const FacePart& part : face.parts) {
        if (part.drive != Drive::kModes) continue;
        for (int i = part.first_node; i < part.first_node + part.nodes; ++i)
            nodes.row(i) = shape.segment<3>(3 * i).transpose();
    }
    const Eigen::VectorXd contours = training.contours.col(k);
    LipContours lips;
    lips.middle = Eigen::Map<const Contour>(contours.data());
    lips.inner = Eigen::Map<const Contour>(contours.data() + 3 * LipGrid::kColumns);
    for (int c = 0; c < LipGrid::kColumns; ++c)
        lips.outer.row(c) = nodes.row(lip_border[static_cast<std::size_t>(c)]);
    nodes.middleRows(face.lips.first_node, LipGrid::kRows * LipGrid::kColumns) = lip_rows(lips);
    return nodes;
}

LidSeat lid_seat(const GenericHead& generic, const Nodes& nodes, std::size_t side) {
    const NodeLoop& lid = generic.lids[side];
    return {extent_of(nodes, lid) / extent_of(generic.face.rest, lid),
            middle_of(generic.face.rest, lid).transpose(), middle_of(nodes, lid).transpose()};
}

Nodes eyes_seated(const GenericHead& generic, Nodes nodes) {
    for (std::size_t side = 0; side < 2; ++side) {
        const LidSeat seat = lid_seat(generic, nodes, side);
        const FacePart& eye = part_named(generic.face, side == 0 ? "eye_left" : "eye_right");
        nodes.middleRows(eye.first_node, eye.nodes) =
            (seat.size * (generic.face.rest.middleRows(eye.first_node, eye.nodes).rowwise() - seat.from))
                .rowwise() +
            seat.to;
    }
    return nodes;
}

GenericHead generic_head(const std::filesystem::path& talker) {
    GenericHead head;
    head.face = read_glb(read_bytes(talker / "face.glb", "talker", 256u << 20));
    head.training = read_training(read_bytes(talker / "estimators.bin", "talker", 256u << 20));
    head.surface = welded_surface(head.face);
    const auto loops = boundary_loops(head.surface);
    head.lids = {loop_round(head.face, loops, part_named(head.face, "eye_left")),
                 loop_round(head.face, loops, part_named(head.face, "eye_right"))};
    for (int c = 0; c < LipGrid::kColumns; ++c) {
        head.lip_border.push_back(head.face.weld[static_cast<std::size_t>(head.face.lips.node(0, c))]);
        head.lip_inner.push_back(head.face.lips.node(LipGrid::kRows - 1, c));
    }
    for (const char* name : {"skin", "lips", "eye_left", "eye_right"})
        head.drawn.push_back(drawn_part(head.face, part_named(head.face, name)));
    return head;
}

}  // namespace viaface
