#include "lipmodel/lip_posterior.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

Eigen::Vector2d imaged(const Pinhole& camera, const Eigen::Vector3d& in_camera) {
    return camera.centre_px + camera.focal_px * in_camera.head<2>() / in_camera.z();
}

Eigen::Vector3d centroid(const Nodes& nodes, const Triangle& t) {
    return (nodes.row(t[0]) + nodes.row(t[1]) + nodes.row(t[2])).transpose() / 3;
}

Eigen::MatrixXd modes_at_centroids(const LipModel& model, const std::vector<ColouredFace>& faces) {
    Eigen::MatrixXd found = Eigen::MatrixXd::Zero(3 * faces.size(), model.modes.cols());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (const int node : faces[f].corners)
            found.middleRows(3 * static_cast<Eigen::Index>(f), 3) += model.modes.middleRows(3 * node, 3) / 3;
    }
    return found;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

Eigen::Matrix3d turn_of(const Eigen::Vector3d& turn) {
    const double angle = turn.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                     : Eigen::Matrix3d::Identity();
}

// J with exp(turn + d) v = exp(turn) v - [exp(turn) v]x J d to first order.
Eigen::Matrix3d turning_slope(const Eigen::Vector3d& turn) {
    const double angle = turn.norm();
    if (angle < 1e-6) return Eigen::Matrix3d::Identity() + 0.5 * cross_matrix(turn);
    const Eigen::Matrix3d k = cross_matrix(turn / angle);
    return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / angle * k +
           (1 - std::sin(angle) / angle) * k * k;
}

}  // namespace

LipPosterior::LipPosterior(const LipModel& model, const Pinhole& camera, const LipPose& expected,
                           const ClassMaps& maps, double gamma, const PoseFreedom& freedom)
    : model_(model),
      maps_(maps),
      camera_(camera),
      expected_(expected),
      gamma_(gamma),
      faces_(coloured_faces()),
      face_modes_(modes_at_centroids(model, faces_)),
      certainty_(model.variance.cwiseInverse()) {
    if (!(gamma > 0)) throw std::invalid_argument("LipPosterior: gamma has to be positive");
    const auto let = [&](double sd, Eigen::Index& first) {
        if (!(sd > 0)) return;
        first = certainty_.size();
        certainty_.conservativeResize(first + 3);
        certainty_.tail(3).setConstant(1 / (sd * sd));
    };
    let(freedom.turn, free_.turn);
    let(freedom.shift, free_.shift);
    let(freedom.scale, free_.scale);
}

Eigen::VectorXd LipPosterior::start(const Eigen::VectorXd& p) const {
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(parameters());
    theta.head(p.size()) = p;
    return theta;
}

Eigen::Vector3d LipPosterior::at(const Eigen::VectorXd& theta, Eigen::Index first) const {
    return first < 0 ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(theta.segment<3>(first));
}

LipPose LipPosterior::pose_of(const Eigen::VectorXd& theta) const {
    LipPose pose = expected_;
    if (free_.turn >= 0) {
        const Eigen::AngleAxisd turned(turn_of(at(theta, free_.turn)) * turn_of(expected_.turn));
        pose.turn = turned.angle() * turned.axis();
    }
    pose.shift += at(theta, free_.shift);
    pose.scale.array() *= at(theta, free_.scale).array().exp();
    return pose;
}

Projected LipPosterior::projected(const Eigen::VectorXd& theta) const {
    return project(camera_, pose_of(theta), as_lip_nodes(lip_shape(model_, modes_of(theta))));
}

const LogMap& LipPosterior::map_of(ColourClass colour) const {
    return colour == ColourClass::kLips   ? maps_.lips
           : colour == ColourClass::kSkin ? maps_.skin
                                          : maps_.opening;
}

Eigen::VectorXd LipPosterior::areas(const Eigen::VectorXd& theta) const { return areas_of(projected(theta)); }

Eigen::VectorXd LipPosterior::areas_of(const Projected& seen) const {
    Eigen::VectorXd areas(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f)
        areas[static_cast<Eigen::Index>(f)] = visible_area(seen.pixels, faces_[f].corners);
    return areas;
}

double LipPosterior::value(const Eigen::VectorXd& theta) const {
    const Projected seen = projected(theta);
    return value_of(theta, seen, areas_of(seen));
}

double LipPosterior::value_at_areas(const Eigen::VectorXd& theta, const Eigen::VectorXd& areas) const {
    return value_of(theta, projected(theta), areas);
}

double LipPosterior::value_of(const Eigen::VectorXd& theta, const Projected& seen,
                              const Eigen::VectorXd& areas) const {
    double sum = -0.5 * theta.cwiseAbs2().dot(certainty_);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const double area = areas[static_cast<Eigen::Index>(f)];
        if (area == 0) continue;
        const Eigen::Vector2d place = imaged(camera_, centroid(seen.in_camera, faces_[f].corners));
        sum += gamma_ * area * map_of(faces_[f].colour).at(place).value;
    }
    return sum;
}

double LipPosterior::mean_fit(const Eigen::VectorXd& theta) const {
    const Eigen::VectorXd area = areas(theta);
    const double of_colours = value_at_areas(theta, area) + 0.5 * theta.cwiseAbs2().dot(certainty_);
    return area.sum() > 0 ? std::exp(of_colours / (gamma_ * area.sum())) : 0;
}

Eigen::MatrixXd LipPosterior::face_slopes(const Eigen::VectorXd& theta) const {
    const Projected seen = projected(theta);
    return slopes_of(theta, seen, areas_of(seen));
}

Eigen::MatrixXd LipPosterior::slopes_of(const Eigen::VectorXd& theta, const Projected& seen,
                                        const Eigen::VectorXd& areas) const {
    const LipPose pose = pose_of(theta);
    const Eigen::Matrix3d turn = camera_from_head(pose), unturn = turn.inverse(),
                          turning = turning_slope(at(theta, free_.turn));
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(areas.size(), parameters());
    for (Eigen::Index f = 0; f < areas.size(); ++f) {
        if (areas[f] == 0) continue;
        const ColouredFace& face = faces_[static_cast<std::size_t>(f)];
        const Eigen::Vector3d middle = centroid(seen.in_camera, face.corners), arm = middle - pose.shift;
        const Eigen::RowVector2d per_px =
            gamma_ * areas[f] * map_of(face.colour).at(imaged(camera_, middle)).slope.transpose();
        const Eigen::RowVector3d per_mm = per_px * pinhole_slope(camera_, middle), in_head = per_mm * turn;
        slopes.row(f).head(model_.modes.cols()) = in_head.lazyProduct(face_modes_.middleRows<3>(3 * f));
        const auto of = [&](Eigen::Index first) { return slopes.block<1, 3>(f, first); };
        if (free_.turn >= 0) of(free_.turn) = arm.cross(per_mm.transpose()).transpose() * turning;
        if (free_.shift >= 0) of(free_.shift) = per_mm;
        if (free_.scale >= 0) of(free_.scale) = (unturn * arm).transpose().cwiseProduct(in_head);
    }
    return slopes;
}

Eigen::VectorXd LipPosterior::gradient(const Eigen::VectorXd& theta) const {
    return face_slopes(theta).colwise().sum().transpose() - theta.cwiseProduct(certainty_);
}

Eigen::VectorXd LipPosterior::ascent(const Eigen::VectorXd& theta) const {
    const Projected seen = projected(theta);
    const Eigen::VectorXd area = areas_of(seen);
    const Eigen::MatrixXd slopes = slopes_of(theta, seen, area);
    const Eigen::VectorXd weight = (gamma_ * area).unaryExpr([](double w) { return w > 0 ? 1 / w : 0; });
    Eigen::MatrixXd metric = slopes.transpose() * weight.asDiagonal() * slopes;
    metric.diagonal() += certainty_;
    const Eigen::VectorXd gradient = slopes.colwise().sum().transpose() - theta.cwiseProduct(certainty_);
    return solve_positive(metric, gradient);
}

}  // namespace viaface
