#include "synth/pose/pose.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/error.hpp"
#include "synth/pose/lids.hpp"
#include "synth/pose/lip_estimator.hpp"
#include "synth/pose/seats.hpp"
#include "synth/pose/teeth_front.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;
constexpr int kColumns = LipGrid::kColumns;
constexpr double kMarkerNoise = 0.3;  // mm: the estimators' ridge

// The 18 face markers and the lower incisor.
Eigen::MatrixXd driving_points(const Eigen::MatrixXd& configurations) {
    Eigen::MatrixXd points(3 * (kFaceMarkers + 1), configurations.cols());
    points << configurations.topRows(3 * kFaceMarkers), configurations.middleRows(3 * kLowerIncisor, 3);
    return points;
}

std::array<Vector3d, 3> tongue_points(const Configuration& c) {
    return {point_of(c, kTongueTip), point_of(c, kTongueBody), point_of(c, kTongueRear)};
}

}  // namespace

struct Poser::Parts {
    Parts(const Face& face, const PoseTraining& training)
        : rest(face.rest),
          rest_points(training.rest),
          lips(face.lips),
          hinge(face.jaw_hinge),
          all_points(training.configurations, training.configurations, {kMarkerNoise}),
          coefficients(
              LinearEstimator(driving_points(training.configurations), training.coefficients, {kMarkerNoise})
                  .for_presence(Presence(kFaceMarkers + 1, true))),
          contours(face.rest, face.lips, training),
          left_lids(face, "eyeBlink_L", +1),
          right_lids(face, "eyeBlink_R", -1),
          left_eye(part_named(face, "eye_left")),
          right_eye(part_named(face, "eye_right")),
          upper(teeth_front(face.rest, part_named(face, "teeth_upper"), +1)),
          lower(teeth_front(face.rest, part_named(face, "teeth_lower"), -1)),
          mouth(part_named(face, "mouth")),
          tongue(part_named(face, "tongue")) {
        if (training.coefficients.rows() != face.modes.cols()) {
            throw std::invalid_argument("the estimators have another number of modes than the face");
        }
        if (mouth.nodes != MouthLining::kNodes || tongue.nodes != TongueSweep::kNodes) {
            throw std::invalid_argument("the face's mouth or tongue has another number of nodes");
        }
        for (const FacePart& part : face.parts) {
            if (part.drive == Drive::kJaw) on_jaw.push_back(part);
            if (part.drive == Drive::kModes) gather_modes(face, part);
        }
        for (int c = 0; c < kColumns; ++c) {
            border.push_back(face.weld[static_cast<std::size_t>(face.lips.node(0, c))]);
        }
        seat_points(face);
    }

    struct Block {
        int first_node, nodes;
        Eigen::MatrixXf modes;  // [3 nodes x modes]
        Eigen::VectorXf mean;   // [3 nodes], mm
    };

    void gather_modes(const Face& face, const FacePart& part) {
        blocks.push_back({part.first_node, part.nodes,
                          face.modes.middleRows(3 * part.first_node, 3 * part.nodes).cast<float>(),
                          face.mean.segment(3 * part.first_node, 3 * part.nodes).cast<float>()});
    }

    void seat_points(const Face& face) {
        for (int p = 0; p < kPoints; ++p) {
            const auto surface = [&]() -> std::vector<Triangle> {
                if (p < kFaceMarkers) return part_named(face, "skin").triangles;
                if (p < kInnerTop) return ring_of(face.lips, 0);
                if (p < kLowerIncisor) return ring_of(face.lips, LipGrid::kRows - 1);
                return part_named(face, p == kLowerIncisor ? "teeth_lower" : "tongue").triangles;
            }();
            seats.push_back(seat_on(face.rest, surface, point_of(rest_points, p)));
        }
    }

    void pose_skin(const FacePose& pose, Nodes& nodes) const {
        const Eigen::VectorXf alpha = pose.coefficients.cast<float>();
        for (const Block& block : blocks) {
            const Eigen::VectorXf placed = block.mean + block.modes * alpha;
            Eigen::Map<Eigen::VectorXd>(nodes.data() + 3 * block.first_node, 3 * block.nodes) =
                placed.cast<double>();
        }
    }

    void pose_eyes(const Blink& blink, const Gaze& gaze, Nodes& nodes) const {
        left_lids.pose(nodes, blink.left, gaze);
        right_lids.pose(nodes, blink.right, gaze);
        if (gaze.left == 0 && gaze.up == 0) return;
        const Eigen::Matrix3d turn = gaze.turn();
        for (const FacePart* part : {&left_eye, &right_eye}) {
            const Eigen::RowVector3d centre =
                eye_ball_of(rest.middleRows(part->first_node, part->nodes)).centre.transpose();
            auto ball = nodes.middleRows(part->first_node, part->nodes);
            ball = ((rest.middleRows(part->first_node, part->nodes).rowwise() - centre) * turn.transpose())
                       .rowwise() +
                   centre;
        }
    }

    LipContours lip_contours(const Configuration& c, const Nodes& skin) const {
        const Eigen::VectorXd flat = contours.contours(c.segment<3 * kLipPoints>(3 * kFirstLipPoint));
        LipContours shape;
        shape.middle = Eigen::Map<const Contour>(flat.data());
        shape.inner = Eigen::Map<const Contour>(flat.data() + 3 * kColumns);
        for (int k = 0; k < kColumns; ++k) shape.outer.row(k) = skin.row(border[static_cast<std::size_t>(k)]);
        return shape;
    }

    void pose_inside(const Configuration& c, const JawMotion& jaw, Nodes& nodes) const {
        for (const FacePart& part : on_jaw) {
            for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
                nodes.row(i) = jaw(rest.row(i).transpose()).transpose();
            }
        }
        Contour inner;
        for (int k = 0; k < kColumns; ++k) inner.row(k) = nodes.row(lips.node(LipGrid::kRows - 1, k));
        nodes.middleRows(mouth.first_node, mouth.nodes) =
            MouthLining::posed(rest.middleRows(mouth.first_node, mouth.nodes), inner, jaw);
        nodes.middleRows(tongue.first_node, tongue.nodes) =
            TongueSweep::posed(rest.middleRows(tongue.first_node, tongue.nodes), tongue_points(rest_points),
                               tongue_points(c), jaw);
    }

    Nodes rest;
    Configuration rest_points;
    LipGrid lips;
    Vector3d hinge;
    LinearEstimator all_points;
    EstimatorFor coefficients;
    LipEstimator contours;
    Lids left_lids, right_lids;
    FacePart left_eye, right_eye;
    TeethFront upper, lower;  // at rest
    FacePart mouth, tongue;
    std::vector<FacePart> on_jaw;
    std::vector<Block> blocks;
    std::vector<int> border;  // the skin's nodes at the lips' outer contour
    std::vector<Seat> seats;  // by point
};

Poser::Poser(const Face& face, const PoseTraining& training)
    : parts_(std::make_unique<Parts>(face, training)) {}
Poser::~Poser() = default;
Poser::Poser(Poser&&) noexcept = default;

Configuration Poser::completed(const Configuration& points) const {
    const Presence present = presence_of(points);
    if (std::all_of(present.begin(), present.end(), [](bool there) { return there; })) return points;
    if (std::none_of(present.begin(), present.end(), [](bool there) { return there; })) {
        throw InputError("points", "none", "at least one point of the layout");
    }
    Configuration complete = parts_->all_points.for_presence(present).estimate(points);
    for (int p = 0; p < kPoints; ++p) {
        if (present[static_cast<std::size_t>(p)]) complete.segment<3>(3 * p) = points.segment<3>(3 * p);
    }
    return complete;
}

FacePose Poser::face_pose(const Configuration& complete) const {
    return {parts_->coefficients.estimate(driving_points(complete))};
}

LipShape Poser::lip_shape(const Configuration& complete, const FacePose& pose) const {
    Nodes nodes = parts_->rest;
    parts_->pose_skin(pose, nodes);
    return {parts_->lip_contours(complete, nodes)};
}

Nodes Poser::posed(const Configuration& points, const Blink& blink, const Gaze& gaze) const {
    const Parts& parts = *parts_;
    const Configuration c = completed(points);
    Nodes nodes = parts.rest;
    parts.pose_skin(face_pose(c), nodes);
    parts.pose_eyes(blink, gaze, nodes);
    const JawMotion jaw =
        jaw_motion(parts.hinge, point_of(parts.rest_points, kLowerIncisor), point_of(c, kLowerIncisor));
    Nodes rows = lip_rows(parts.lip_contours(c, nodes));
    keep_off_teeth(rows, parts.upper);
    keep_off_teeth(rows, moved_front(parts.lower, jaw));
    keep_lips_apart(rows);
    nodes.middleRows(parts.lips.first_node, rows.rows()) = rows;
    parts.pose_inside(c, jaw, nodes);
    return nodes;
}

Configuration Poser::drawn_points(const Nodes& posed) const {
    Configuration c;
    for (int p = 0; p < kPoints; ++p)
        c.segment<3>(3 * p) = parts_->seats[static_cast<std::size_t>(p)].at(posed);
    return c;
}

std::array<double, 3> Poser::drawn_gaps(const Nodes& posed) const {
    const Nodes rows = posed.middleRows(parts_->lips.first_node, LipGrid::kRows * kColumns);
    return {lip_gap(rows, 0), lip_gap(rows, kLeftCorner / 2), lip_gap(rows, kColumns - kLeftCorner / 2)};
}

}  // namespace viaface
