#include "synth/scans/borrowed_motion.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <optional>

#include "facemodel/deformation_transfer.hpp"
#include "facemodel/lips.hpp"
#include "facemodel/pca.hpp"
#include "synth/pose/eye_ball.hpp"
#include "synth/pose/inside.hpp"
#include "synth/pose/seats.hpp"

namespace viaface {
namespace {

using Eigen::RowVector3d, Eigen::Vector3d;

constexpr double kModeTolerance = 1e-5;  // of the largest singular value

Eigen::VectorXd flat(const Nodes& nodes) {
    return Eigen::Map<const Eigen::VectorXd>(nodes.data(), nodes.size());
}

void weld(const Face& face, Nodes& nodes) {
    for (std::size_t i = 0; i < face.weld.size(); ++i)
        nodes.row(static_cast<Eigen::Index>(i)) = nodes.row(face.weld[i]).eval();
}

bool on_surface(const FacePart& part) {
    return part.name == "skin" || part.name == "head_back" || part.name == "lips";
}

Contour row_of(const LipGrid& lips, const Nodes& nodes, int row) {
    return nodes.middleRows(lips.node(row, 0), LipGrid::kColumns);
}

RowVector3d middle_of(const Nodes& nodes, const NodeLoop& loop) {
    RowVector3d sum = RowVector3d::Zero();
    for (const int node : loop) sum += nodes.row(node);
    return sum / static_cast<double>(loop.size());
}

double extent_of(const Nodes& nodes, const NodeLoop& loop) {
    const RowVector3d middle = middle_of(nodes, loop);
    double sum = 0;
    for (const int node : loop) sum += (nodes.row(node) - middle).head<2>().norm();
    return sum;
}

class Borrowing {
  public:
    Borrowing(const GenericHead& lender, Nodes nodes)
        : lender_(lender), face_(lender.face), rest_(std::move(nodes)) {
        weld(face_, rest_);
        seat_mouth();
        seat_eyes();
        for (Eigen::Index k = 0; k < lender.training.coefficients.cols(); ++k)
            postures_.push_back(lender_posture(lender, k));
        seat_points();
        transfer_.emplace(face_.rest, rest_, lender.surface, still_nodes());
    }

    BorrowedTalker talker(const Codex& codex, double size) const {
        BorrowedTalker talker;
        talker.face = face_;
        talker.shift = shift_;
        talker.size = size;
        add_modes(talker);
        add_shapes(talker.face);
        scale(talker, size);
        talker.codex = borrowed_codex(codex, talker);
        return talker;
    }

  private:
    // The whole head shifted so that the lips meet before the lender's teeth.
    void seat_mouth() {
        shift_ = (middle_of(face_.rest, lender_.lip_inner) - middle_of(rest_, lender_.lip_inner)).transpose();
        rest_.rowwise() += shift_.transpose();
        for (const FacePart& part : face_.parts) {
            if (!on_surface(part))
                rest_.middleRows(part.first_node, part.nodes) =
                    face_.rest.middleRows(part.first_node, part.nodes);
        }
        const FacePart& mouth = part_named(face_, "mouth");
        rest_.middleRows(mouth.first_node, mouth.nodes) =
            MouthLining::rest(row_of(face_.lips, rest_, LipGrid::kRows - 1));
    }

    void seat_eyes() {
        for (std::size_t side = 0; side < 2; ++side) {
            const NodeLoop& lid = lender_.lids[side];
            const double size = extent_of(rest_, lid) / extent_of(face_.rest, lid);
            const RowVector3d from = middle_of(face_.rest, lid), to = middle_of(rest_, lid);
            const FacePart& eye = part_named(face_, side == 0 ? "eye_left" : "eye_right");
            auto ball = rest_.middleRows(eye.first_node, eye.nodes);
            ball = (size * (ball.rowwise() - from)).rowwise() + to;
            for (const char* lid_name : {"lashes_upper_", "lashes_lower_"}) {
                const FacePart& lashes =
                    part_named(face_, std::string(lid_name) + (side == 0 ? "left" : "right"));
                for (int i = lashes.first_node; i < lashes.first_node + lashes.nodes; ++i)
                    seat_lash(i, lid, size);
            }
        }
    }

    // A lash goes with the three nodes of the lid's edge nearest to it.
    void seat_lash(int lash, const NodeLoop& lid, double size) {
        std::vector<int> near(lid);
        std::ranges::stable_sort(
            near, {}, [&](int node) { return (face_.rest.row(node) - face_.rest.row(lash)).norm(); });
        near.resize(3);
        const RowVector3d from = middle_of(face_.rest, near), to = middle_of(rest_, near);
        rest_.row(lash) = to + size * (face_.rest.row(lash) - from);
    }

    void seat_points() {
        for (int p = 0; p < kLowerIncisor; ++p) {
            const auto surface = p < kFaceMarkers ? part_named(face_, "skin").triangles
                                 : p < kInnerTop  ? ring_of(face_.lips, 0)
                                                  : ring_of(face_.lips, LipGrid::kRows - 1);
            seats_.push_back(seat_on(face_.rest, surface, point_of(lender_.training.rest, p)));
        }
    }

    std::vector<bool> still_nodes() const {
        constexpr double kStill = 0.02;  // mm
        Eigen::VectorXd most = Eigen::VectorXd::Zero(rest_.rows());
        for (const Nodes& posture : postures_) most = most.cwiseMax((posture - face_.rest).rowwise().norm());
        for (const NamedShape& shape : face_.shapes) most = most.cwiseMax(shape.delta.rowwise().norm());
        std::vector<bool> still(static_cast<std::size_t>(rest_.rows()));
        for (Eigen::Index i = 0; i < most.size(); ++i) still[static_cast<std::size_t>(i)] = most[i] < kStill;
        return still;
    }

    Nodes transferred(Nodes pose) const {
        weld(face_, pose);
        Nodes moved = (*transfer_)(pose);
        Nodes result = rest_;
        for (const FacePart& part : face_.parts) {
            if (on_surface(part))
                result.middleRows(part.first_node, part.nodes) =
                    moved.middleRows(part.first_node, part.nodes);
        }
        weld(face_, result);
        return result;
    }

    // Points of a posture: at their seats on the skin and the lips, off them as the lender's are.
    Configuration points(const Nodes& nodes, const Nodes& lender_nodes,
                         const Configuration& lender_points) const {
        Configuration found = lender_points;
        for (int p = 0; p < kLowerIncisor; ++p) {
            const Seat seat = seats_[static_cast<std::size_t>(p)];
            found.segment<3>(3 * p) += seat.at(nodes) - seat.at(lender_nodes);
        }
        return found;
    }

    void add_modes(BorrowedTalker& talker) const {
        const auto count = static_cast<Eigen::Index>(postures_.size());
        PoseTraining& training = talker.training;
        training = lender_.training;
        training.rest = points(rest_, face_.rest, lender_.training.rest);
        Eigen::MatrixXd shapes = flat(rest_).replicate(1, count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const Nodes pose = transferred(postures_[static_cast<std::size_t>(k)]);
            training.configurations.col(k) =
                points(pose, postures_[static_cast<std::size_t>(k)], lender_.training.configurations.col(k));
            const Contour middle = row_of(face_.lips, pose, LipGrid::kMiddleRow),
                          inner = row_of(face_.lips, pose, LipGrid::kRows - 1);
            training.contours.col(k) << Eigen::Map<const Eigen::VectorXd>(middle.data(), middle.size()),
                Eigen::Map<const Eigen::VectorXd>(inner.data(), inner.size());
            for (const FacePart& part : face_.parts) {
                if (part.drive == Drive::kModes)
                    shapes.col(k).segment(3 * part.first_node, 3 * part.nodes) =
                        flat(pose).segment(3 * part.first_node, 3 * part.nodes);
            }
        }
        const PrincipalComponents components = principal_components(shapes, -1, kModeTolerance);
        talker.face.rest = rest_;
        talker.face.mean = components.mean;
        talker.face.modes = components.modes;
        talker.face.mode_variance = components.variance;
        training.coefficients = components.all_coefficients(shapes);
    }

    void add_shapes(Face& face) const {
        for (NamedShape& shape : face.shapes) {
            const Nodes moved = transferred(face_.rest + shape.delta) - rest_;
            for (const FacePart& part : face_.parts) {
                if (on_surface(part))
                    shape.delta.middleRows(part.first_node, part.nodes) =
                        moved.middleRows(part.first_node, part.nodes);
            }
        }
    }

    static void scale(BorrowedTalker& talker, double size) {
        Face& face = talker.face;
        face.rest *= size;
        face.mean *= size;
        face.mode_variance *= size * size;
        face.jaw_hinge *= size;
        for (NamedShape& shape : face.shapes) shape.delta *= size;
        talker.training.rest *= size;
        talker.training.configurations *= size;
        talker.training.coefficients *= size;
        talker.training.contours *= size;
    }

    Codex borrowed_codex(const Codex& codex, BorrowedTalker& talker) const {
        const PoseTraining &from = lender_.training, &to = talker.training;
        for (int axis = 0; axis < 3; ++axis) {
            double product = 0, square = 0;
            for (Eigen::Index k = 0; k < from.configurations.cols(); ++k) {
                for (int p = 0; p < kLowerIncisor; ++p) {
                    const double was = from.configurations(3 * p + axis, k) - from.rest[3 * p + axis];
                    product += was * (to.configurations(3 * p + axis, k) - to.rest[3 * p + axis]);
                    square += was * was;
                }
            }
            talker.motion_scale[axis] = square > 0 ? product / square : 1;
        }
        const Configuration ratio = talker.motion_scale.replicate(kPoints, 1);
        ConfigurationBasis basis;
        basis.mean = to.rest + ratio.cwiseProduct(codex.basis.mean - from.rest);
        const Eigen::MatrixXd moved = ratio.asDiagonal() * codex.basis.modes;
        const Eigen::HouseholderQR<Eigen::MatrixXd> factors(moved);
        basis.modes = factors.householderQ() * Eigen::MatrixXd::Identity(moved.rows(), moved.cols());
        const Eigen::MatrixXd change = basis.modes.transpose() * moved;
        auto recitations = codex.recitations;
        for (Recitation& recitation : recitations) {
            for (RecitedPhone& phone : recitation)
                phone.points = RowMatrix(phone.points * change.transpose());
        }
        return make_codex(basis, change * codex.rest, std::move(recitations),
                          codex.provenance + " Scaled to another face.");
    }

    const GenericHead& lender_;
    const Face& face_;
    Nodes rest_;
    Vector3d shift_ = Vector3d::Zero();
    std::vector<Nodes> postures_;
    std::optional<DeformationTransfer> transfer_;
    std::vector<Seat> seats_;
};

}  // namespace

Nodes lender_posture(const GenericHead& lender, Eigen::Index posture) {
    const Face& face = lender.face;
    Nodes nodes = face.rest;
    const Eigen::VectorXd shape = face.mean + face.modes * lender.training.coefficients.col(posture);
    for (const FacePart& part : face.parts) {
        if (part.drive != Drive::kModes) continue;
        for (int i = part.first_node; i < part.first_node + part.nodes; ++i)
            nodes.row(i) = shape.segment<3>(3 * i).transpose();
    }
    const Eigen::VectorXd contours = lender.training.contours.col(posture);
    LipContours lips;
    lips.middle = Eigen::Map<const Contour>(contours.data());
    lips.inner = Eigen::Map<const Contour>(contours.data() + 3 * LipGrid::kColumns);
    for (int c = 0; c < LipGrid::kColumns; ++c)
        lips.outer.row(c) = nodes.row(lender.lip_border[static_cast<std::size_t>(c)]);
    nodes.middleRows(face.lips.first_node, LipGrid::kRows * LipGrid::kColumns) = lip_rows(lips);
    return nodes;
}

BorrowedTalker with_borrowed_motion(const GenericHead& lender, const Codex& codex, Nodes nodes, double size) {
    return Borrowing(lender, std::move(nodes)).talker(codex, size);
}

}  // namespace viaface
