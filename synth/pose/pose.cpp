#include "synth/pose/pose.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/error.hpp"
#include "synth/pose/eye_ball.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;
constexpr int kColumns = LipGrid::kColumns;
constexpr double kMarkerNoise = 0.3, kLipNoise = 0.3;  // mm: the ridges of the two estimators

// The 18 face markers and the lower incisor.
Eigen::MatrixXd driving_points(const Eigen::MatrixXd& configurations) {
    Eigen::MatrixXd points(3 * (kFaceMarkers + 1), configurations.cols());
    points << configurations.topRows(3 * kFaceMarkers), configurations.middleRows(3 * kLowerIncisor, 3);
    return points;
}

const FacePart& part_named(const Face& face, const std::string& name) {
    const auto found =
        std::find_if(face.parts.begin(), face.parts.end(), [&](const FacePart& p) { return p.name == name; });
    if (found == face.parts.end()) throw std::invalid_argument("the face has no part " + name);
    return *found;
}

// Where a point sits on the mesh: a mean of nodes and a step off the surface.
struct Seat {
    Triangle nodes{};
    Vector3d weights = Vector3d::Zero(), step = Vector3d::Zero();

    Vector3d at(const Nodes& mesh) const {
        return weights[0] * mesh.row(nodes[0]).transpose() + weights[1] * mesh.row(nodes[1]).transpose() +
               weights[2] * mesh.row(nodes[2]).transpose() + step;
    }
};

// Weights of the nearest place of a triangle (Ericson's regions, by projection and clamping to the edges).
Vector3d nearest_weights(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
    const Vector3d u = b - a, v = c - a, w = p - a;
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
    const double area = uu * vv - uv * uv;
    if (area > 0) {
        const double s = (wu * vv - wv * uv) / area, t = (wv * uu - wu * uv) / area;
        if (s >= 0 && t >= 0 && s + t <= 1) return {1 - s - t, s, t};
    }
    const auto on_edge = [&](const Vector3d& from, const Vector3d& to) {
        return std::clamp((p - from).dot(to - from) / std::max((to - from).squaredNorm(), 1e-12), 0.0, 1.0);
    };
    const double ab = on_edge(a, b), bc = on_edge(b, c), ca = on_edge(c, a);
    const std::array<Vector3d, 3> candidates = {Vector3d(1 - ab, ab, 0), Vector3d(0, 1 - bc, bc),
                                                Vector3d(ca, 0, 1 - ca)};
    return *std::min_element(candidates.begin(), candidates.end(), [&](const Vector3d& k, const Vector3d& l) {
        return (k[0] * a + k[1] * b + k[2] * c - p).norm() < (l[0] * a + l[1] * b + l[2] * c - p).norm();
    });
}

Seat seat_on(const Nodes& mesh, const std::vector<Triangle>& triangles, const Vector3d& place) {
    Seat best;
    double least = 1e300;
    for (const Triangle& t : triangles) {
        const Vector3d a = mesh.row(t[0]), b = mesh.row(t[1]), c = mesh.row(t[2]);
        const Seat seat{t, nearest_weights(a, b, c, place), Vector3d::Zero()};
        const double distance = (seat.at(mesh) - place).norm();
        if (distance >= least) continue;
        least = distance;
        best = seat;
    }
    best.step = place - best.at(mesh);
    return best;
}

// A row of the lips as a ring of degenerate triangles, so that a point may sit between two columns.
std::vector<Triangle> ring_of(const LipGrid& lips, int row) {
    std::vector<Triangle> ring;
    for (int c = 0; c < kColumns; ++c)
        ring.push_back({lips.node(row, c), lips.node(row, c + 1), lips.node(row, c)});
    return ring;
}

// Column of a seat on a ring, with its part of the way to the next.
double column_of(const Seat& seat, const LipGrid& lips, int row) {
    const int column = seat.nodes[0] - lips.node(row, 0);
    return column + seat.weights[1];
}

// Spreads values at eight columns over the whole ring: a closed cubic spline. [40 x 8]
Eigen::MatrixXd spread(const std::array<double, 8>& columns) {
    Eigen::Matrix<double, 8, 8> system = Eigen::Matrix<double, 8, 8>::Zero(), right = system;
    std::array<double, 8> h{};
    for (int k = 0; k < 8; ++k) {
        h[static_cast<std::size_t>(k)] = std::fmod(
            columns[static_cast<std::size_t>((k + 1) % 8)] - columns[static_cast<std::size_t>(k)] + kColumns,
            kColumns);
        if (h[static_cast<std::size_t>(k)] < 0.5)
            throw std::invalid_argument("the lip points are out of order");
    }
    for (int k = 0; k < 8; ++k) {
        const double before = h[static_cast<std::size_t>((k + 7) % 8)],
                     after = h[static_cast<std::size_t>(k)];
        system(k, (k + 7) % 8) = before;
        system(k, k) = 2 * (before + after);
        system(k, (k + 1) % 8) = after;
        right(k, (k + 7) % 8) += 6 / before;
        right(k, k) -= 6 / before + 6 / after;
        right(k, (k + 1) % 8) += 6 / after;
    }
    const Eigen::Matrix<double, 8, 8> bend = system.inverse() * right;
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(kColumns, 8);
    for (int c = 0; c < kColumns; ++c) {
        for (int k = 0; k < 8; ++k) {
            const double span = h[static_cast<std::size_t>(k)];
            const double t = std::fmod(c - columns[static_cast<std::size_t>(k)] + 2 * kColumns, kColumns) /
                             span,
                         s = 1 - t;
            if (t < 0 || t >= 1) continue;
            weights.row(c) =
                span * span / 6 * ((s * s * s - s) * bend.row(k) + (t * t * t - t) * bend.row((k + 1) % 8));
            weights(c, k) += s;
            weights(c, (k + 1) % 8) += t;
        }
    }
    return weights;
}

// The nodes that a blink moves, and by how much. The lids slide over the eyeball.
struct BlinkMoves {
    std::vector<int> nodes;
    Nodes moves;
    std::vector<double> rest_radius;  // mm from the eye's centre
    EyeBall ball;

    BlinkMoves(const Face& face, const std::string& name, double side) : ball(eye_ball(side)) {
        const auto shape = std::find_if(face.shapes.begin(), face.shapes.end(),
                                        [&](const NamedShape& s) { return s.name == name; });
        if (shape == face.shapes.end()) throw std::invalid_argument("the face has no shape " + name);
        for (int i = 0; i < shape->delta.rows(); ++i) {
            if (shape->delta.row(i).norm() > 1e-3) nodes.push_back(i);
        }
        moves.resize(static_cast<Eigen::Index>(nodes.size()), 3);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            moves.row(static_cast<Eigen::Index>(k)) = kShutting * shape->delta.row(nodes[k]);
            rest_radius.push_back((face.rest.row(nodes[k]).transpose() - ball.centre).norm());
        }
    }

    void add_to(Nodes& mesh, double amount) const {
        if (amount == 0) return;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            auto node = mesh.row(nodes[k]);
            node += amount * moves.row(static_cast<Eigen::Index>(k));
            if (rest_radius[k] < EyeBall::kRadius || rest_radius[k] > kLidReach) continue;
            const Vector3d from = node.transpose() - ball.centre;
            const double angle = std::acos(std::clamp(from.z() / from.norm(), -1.0, 1.0));
            const double least = EyeBall::radius_at(angle) + kLidThickness;
            if (from.norm() < least) node = (ball.centre + from * (least / from.norm())).transpose();
        }
    }

    static constexpr double kShutting = 1.12;      // the scan's lids stop 0.9 mm short of each other
    static constexpr double kLidThickness = 0.35;  // mm
    static constexpr double kLidReach = 22;        // mm: farther nodes are no lid
};

// The 16 lip points to the middle and the inner contour.
class LipEstimator {
  public:
    LipEstimator(const Nodes& rest, const LipGrid& lips, const PoseTraining& training) {
        std::array<double, 8> border{}, inner{};
        for (std::size_t k = 0; k < 8; ++k) {
            const int at = kFirstLipPoint + static_cast<int>(k);
            border[k] = column_of(seat_on(rest, ring_of(lips, 0), point_of(training.rest, at)), lips, 0);
            inner[k] =
                column_of(seat_on(rest, ring_of(lips, LipGrid::kRows - 1), point_of(training.rest, at + 8)),
                          lips, LipGrid::kRows - 1);
        }
        const Eigen::MatrixXd from_border = spread(border), from_inner = spread(inner);
        spread_ = Eigen::MatrixXd::Zero(2 * kColumns, kLipPoints);
        spread_.topLeftCorner(kColumns, 8) = 0.5 * from_border;
        spread_.topRightCorner(kColumns, 8) = 0.5 * from_inner;
        spread_.bottomRightCorner(kColumns, 8) = from_inner;
        rest_points_ = training.rest.segment<3 * kLipPoints>(3 * kFirstLipPoint);
        rest_.resize(PoseTraining::kContourNumbers);
        for (int c = 0; c < kColumns; ++c) {
            rest_.segment<3>(3 * c) = rest.row(lips.node(LipGrid::kMiddleRow, c)).transpose();
            rest_.segment<3>(3 * (kColumns + c)) = rest.row(lips.node(LipGrid::kRows - 1, c)).transpose();
        }
        const Eigen::MatrixXd points = training.configurations.middleRows(3 * kFirstLipPoint, 3 * kLipPoints);
        Eigen::MatrixXd left_out = training.contours;
        for (Eigen::Index k = 0; k < points.cols(); ++k) left_out.col(k) -= spread_out(points.col(k));
        residual_ = LinearEstimator(points, left_out, {kLipNoise}).for_presence(Presence(kLipPoints, true));
    }

    Eigen::VectorXd contours(const Eigen::VectorXd& points) const {
        return spread_out(points) + residual_.estimate(points);
    }

  private:
    using PointRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

    Eigen::VectorXd spread_out(const Eigen::VectorXd& points) const {
        const Eigen::VectorXd moved = points - rest_points_;
        const PointRows spread = spread_ * Eigen::Map<const PointRows>(moved.data(), kLipPoints, 3);
        return rest_ + Eigen::Map<const Eigen::VectorXd>(spread.data(), spread.size());
    }

    Eigen::MatrixXd spread_;  // [80 x 16]
    Eigen::VectorXd rest_points_, rest_;
    EstimatorFor residual_;
};

// The teeth's front, read off their nodes: foremost place at the middle, fall with x^2, height of the edges.
TeethFront teeth_front(const Face& face, const std::string& name, double side) {
    constexpr double kFrontHalf = 15, kMiddleHalf = 4, kVisible = 8;  // mm
    const FacePart& part = part_named(face, name);
    TeethFront front{-1e9, 0, side * 1e9, side, 2.0};
    for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
        if (std::abs(face.rest(i, 0)) > kMiddleHalf) continue;
        if (side * face.rest(i, 1) < side * front.edge_y) front.edge_y = face.rest(i, 1);
    }
    const auto crown = [&](int i) { return side * (face.rest(i, 1) - front.edge_y) < kVisible; };
    for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
        if (crown(i) && std::abs(face.rest(i, 0)) < kMiddleHalf)
            front.front_z = std::max(front.front_z, face.rest(i, 2));
    }
    double least = 1e9;
    for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
        const double x = face.rest(i, 0);
        if (!crown(i) || std::abs(x) < kMiddleHalf || std::abs(x) > kFrontHalf) continue;
        least = std::min(least, (front.front_z - face.rest(i, 2)) / (x * x));
    }
    front.curvature = std::max(least, 0.0);
    return front;
}

TeethFront moved_front(TeethFront front, const JawMotion& jaw) {
    const Vector3d edge(0, front.edge_y, front.front_z), now = jaw(edge);
    front.edge_y = now.y();
    front.front_z = now.z();
    return front;
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
          blink_left(face, "eyeBlink_L", +1),
          blink_right(face, "eyeBlink_R", -1),
          upper(teeth_front(face, "teeth_upper", +1)),
          lower(teeth_front(face, "teeth_lower", -1)),
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
            seats.push_back(seat_on(face.rest, surface, point_of(training_rest(), p)));
        }
    }
    const Configuration& training_rest() const { return rest_points; }

    void pose_skin(const FacePose& pose, const Blink& blink, Nodes& nodes) const {
        const Eigen::VectorXf alpha = pose.coefficients.cast<float>();
        for (const Block& block : blocks) {
            const Eigen::VectorXf placed = block.mean + block.modes * alpha;
            Eigen::Map<Eigen::VectorXd>(nodes.data() + 3 * block.first_node, 3 * block.nodes) =
                placed.cast<double>();
        }
        blink_left.add_to(nodes, blink.left);
        blink_right.add_to(nodes, blink.right);
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
    BlinkMoves blink_left, blink_right;
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
    parts_->pose_skin(pose, {}, nodes);
    return {parts_->lip_contours(complete, nodes)};
}

Nodes Poser::posed(const Configuration& points, const Blink& blink) const {
    const Parts& parts = *parts_;
    const Configuration c = completed(points);
    Nodes nodes = parts.rest;
    parts.pose_skin(face_pose(c), blink, nodes);
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
