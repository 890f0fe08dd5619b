#include "synth/scans/borrowed_motion.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/decompositions.hpp"
#include "facemodel/deformation_transfer.hpp"
#include "facemodel/estimator.hpp"
#include "facemodel/lips.hpp"
#include "facemodel/pca.hpp"
#include "synth/pose/eye_ball.hpp"
#include "synth/pose/inside.hpp"
#include "synth/pose/seats.hpp"
#include "synth/scans/surface_fit.hpp"
#include "synth/training/postures.hpp"

namespace viaface {
namespace {

using Eigen::RowVector3d, Eigen::Vector3d;

constexpr double kModeTolerance = 1e-5;  // of the largest singular value

Eigen::VectorXd flat(const Nodes& nodes) {
    return Eigen::Map<const Eigen::VectorXd>(nodes.data(), nodes.size());
}

bool on_surface(const FacePart& part) {
    return part.name == "skin" || part.name == "head_back" || part.name == "lips";
}

Contour row_of(const LipGrid& lips, const Nodes& nodes, int row) {
    return nodes.middleRows(lips.node(row, 0), LipGrid::kColumns);
}

class Borrowing {
  public:
    Borrowing(const GenericHead& lender, Nodes nodes, const std::vector<OwnPosture>& own)
        : lender_(lender), face_(lender.face), rest_(std::move(nodes)), jaw_and_tongue_(behind(lender)) {
        weld_nodes(face_, rest_);
        seat_mouth();
        seat_eyes();
        for (Eigen::Index k = 0; k < lender.training.coefficients.cols(); ++k)
            postures_.push_back(lender.posture(k));
        seat_points();
        transfer_.emplace(face_.rest, rest_, lender.surface, still_nodes());
        for (const OwnPosture& posture : own)
            own_.emplace(posture.name, on_rest(posture.nodes.rowwise() + shift_.transpose()));
        for (const NamedShape& shape : face_.shapes) {
            const auto own = own_.find(shape.name);
            if (own != own_.end())
                own_change_.emplace(shape.name, own->second - transferred(face_.rest + shape.delta));
        }
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
        shift_ = middle_of(face_.rest, lender_.lip_inner) - middle_of(rest_, lender_.lip_inner);
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
        rest_ = eyes_seated(lender_, std::move(rest_));
        for (std::size_t side = 0; side < 2; ++side) {
            const double size = lid_seat(lender_, rest_, side).size;
            for (const char* lid_name : {"lashes_upper_", "lashes_lower_"}) {
                const FacePart& lashes =
                    part_named(face_, std::string(lid_name) + (side == 0 ? "left" : "right"));
                for (int i = lashes.first_node; i < lashes.first_node + lashes.nodes; ++i)
                    seat_lash(i, lender_.lids[side], size);
            }
        }
    }

    // A lash goes with the three nodes of the lid's edge nearest to it.
    void seat_lash(int lash, const NodeLoop& lid, double size) {
        std::vector<int> near(lid);
        std::ranges::stable_sort(
            near, {}, [&](int node) { return (face_.rest.row(node) - face_.rest.row(lash)).norm(); });
        near.resize(3);
        const RowVector3d from = middle_of(face_.rest, near).transpose(),
                          to = middle_of(rest_, near).transpose();
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
        weld_nodes(face_, pose);
        return on_rest((*transfer_)(pose));
    }

    // The surface's nodes of a posture, all others at rest.
    Nodes on_rest(const Nodes& surface) const {
        Nodes result = rest_;
        for (const FacePart& part : face_.parts) {
            if (on_surface(part))
                result.middleRows(part.first_node, part.nodes) =
                    surface.middleRows(part.first_node, part.nodes);
        }
        weld_nodes(face_, result);
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

    // Lower incisor and tongue of the lender's postures, by their points on skin and lips.
    static LinearEstimator behind(const GenericHead& lender) {
        constexpr double kNoise = 0.5;  // mm
        const Eigen::MatrixXd& all = lender.training.configurations;
        return {all.topRows(3 * kLowerIncisor), all.bottomRows(all.rows() - 3 * kLowerIncisor), {kNoise}};
    }

    // Points of a scanned posture: what no scan shows, as the lender moves it along.
    Configuration own_points(const Nodes& nodes) const {
        const Configuration& lender_rest = lender_.training.rest;
        Configuration found = points(rest_, face_.rest, lender_rest);
        Eigen::VectorXd outside = lender_rest.head(3 * kLowerIncisor);
        for (int p = 0; p < kLowerIncisor; ++p) {
            const Seat& seat = seats_[static_cast<std::size_t>(p)];
            const Vector3d way = seat.at(nodes) - seat.at(rest_);
            found.segment<3>(3 * p) += way;
            outside.segment<3>(3 * p) += way;
        }
        const Eigen::Index inside = kCoordinates - 3 * kLowerIncisor;
        found.tail(inside) += jaw_and_tongue_.estimate(outside) - lender_rest.tail(inside);
        return found;
    }

    struct Posed {
        Nodes nodes;
        Configuration points;
    };

    std::string posture_name(std::size_t k) const {
        return postures_.size() == talker_postures().size() ? talker_postures()[k].name : "";
    }

    // What scanned named shapes change in a mix of them.
    std::optional<Nodes> own_share(const ShapeWeights& mix) const {
        std::optional<Nodes> change;
        for (const auto& [shape, own] : own_change_) {
            for (const auto& [name, weight] : mix) {
                if (shape != name && shape != name + "_L" && shape != name + "_R") continue;
                if (!change) change = Nodes::Zero(rest_.rows(), 3);
                *change += weight * own;
            }
        }
        return change;
    }

    Posed posed(std::size_t k) const {
        const std::string name = posture_name(k);
        if (const auto own = own_.find(name); own != own_.end())
            return {own->second, own_points(own->second)};
        Nodes nodes = transferred(postures_[k]);
        const auto change = name.empty() ? std::nullopt : own_share(talker_postures()[k].weights);
        if (change) {
            nodes += *change;
            return {nodes, own_points(nodes)};
        }
        return {nodes, points(nodes, postures_[k],
                              lender_.training.configurations.col(static_cast<Eigen::Index>(k)))};
    }

    // The lender's, as far as no scan takes their place, then what was scanned beyond them.
    std::vector<Posed> all_posed() const {
        std::vector<Posed> all;
        std::set<std::string> known;
        for (std::size_t k = 0; k < postures_.size(); ++k) {
            all.push_back(posed(k));
            known.insert(posture_name(k));
        }
        for (const NamedShape& shape : face_.shapes) known.insert(shape.name);
        for (const auto& [name, nodes] : own_) {
            if (!known.contains(name)) all.push_back({nodes, own_points(nodes)});
        }
        return all;
    }

    void add_modes(BorrowedTalker& talker) const {
        const std::vector<Posed> all = all_posed();
        const auto count = static_cast<Eigen::Index>(all.size());
        PoseTraining& training = talker.training;
        training.rest = points(rest_, face_.rest, lender_.training.rest);
        training.configurations.resize(kCoordinates, count);
        training.contours.resize(PoseTraining::kContourNumbers, count);
        Eigen::MatrixXd shapes = flat(rest_).replicate(1, count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const Nodes& pose = all[static_cast<std::size_t>(k)].nodes;
            training.configurations.col(k) = all[static_cast<std::size_t>(k)].points;
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
        for (const auto& [name, nodes] : own_) talker.own.push_back(name);
    }

    void add_shapes(Face& face) const {
        for (NamedShape& shape : face.shapes) {
            const auto own = own_.find(shape.name);
            const Nodes moved =
                (own != own_.end() ? own->second : transferred(face_.rest + shape.delta)) - rest_;
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
        basis.modes = thin_qr(moved).q;
        const Eigen::MatrixXd change = basis.modes.transpose() * moved;
        auto recitations = codex.recitations;
        for (Recitation& recitation : recitations) {
            for (RecitedPhone& phone : recitation)
                phone.points = RowMatrix(phone.points * change.transpose());
        }
        return make_codex(basis, change * codex.rest, std::move(recitations),
                          codex.provenance + " Scaled to another face.", codex.scatter_mm);
    }

    const GenericHead& lender_;
    const Face& face_;
    Nodes rest_;
    Vector3d shift_ = Vector3d::Zero();
    std::vector<Nodes> postures_;
    std::optional<DeformationTransfer> transfer_;
    std::vector<Seat> seats_;
    LinearEstimator jaw_and_tongue_;
    std::map<std::string, Nodes> own_;         // scanned postures and named shapes, as on_rest gives them
    std::map<std::string, Nodes> own_change_;  // of each scanned named shape, from the transferred one
};

}  // namespace

BorrowedTalker with_borrowed_motion(const GenericHead& lender, const Codex& codex, Nodes nodes, double size,
                                    const std::vector<OwnPosture>& own) {
    return Borrowing(lender, std::move(nodes), own).talker(codex, size);
}

}  // namespace viaface
