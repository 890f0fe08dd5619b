#include "synth/pose/lids.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

constexpr double kShuts = 1.12;         // the scan's lids stop 0.9 mm short of each other
constexpr double kPast = 0.9;           // mm: how far the upper lid comes to lie over the lower one
constexpr double kLidThickness = 0.35;  // mm
constexpr double kLidOverLid = 0.45;    // mm: the upper one before the lower one, shut
constexpr double kLidReach = 22;        // mm: farther nodes are no lid
constexpr double kFollow = 0.02;        // of a blink per degree of the gaze downwards
constexpr double kWidest = -0.2;        // of a blink

double amount_of(double blink, const Gaze& gaze) {
    const double follow = std::clamp(-kFollow * gaze.up, kWidest, 1.0);
    return blink + (1 - blink) * follow;
}

EyeBall eye_of(const Face& face, double side) {
    const FacePart& part = part_named(face, side > 0 ? "eye_left" : "eye_right");
    return eye_ball_of(face.rest.middleRows(part.first_node, part.nodes));
}

}  // namespace

Lids::Lids(const Face& face, const std::string& shape_name, double side) : ball_(eye_of(face, side)) {
    const auto shape = std::find_if(face.shapes.begin(), face.shapes.end(),
                                    [&](const NamedShape& s) { return s.name == shape_name; });
    if (shape == face.shapes.end()) throw std::invalid_argument("the face has no shape " + shape_name);
    for (int i = 0; i < shape->delta.rows(); ++i) {
        if (shape->delta.row(i).norm() > 1e-3) nodes_.push_back(i);
    }
    moves_.resize(static_cast<Eigen::Index>(nodes_.size()), 3);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const auto delta = shape->delta.row(nodes_[k]);
        auto move = moves_.row(static_cast<Eigen::Index>(k));
        move = kShuts * delta;
        if (delta.y() < 0) move += kPast * std::min(1.0, delta.norm() / kPast) * delta.normalized();
        rest_radius_.push_back((face.rest.row(nodes_[k]).transpose() - ball_.centre).norm());
    }
}

void Lids::pose(Nodes& mesh, double blink, const Gaze& gaze) const {
    const double amount = amount_of(blink, gaze);
    if (amount == 0 && gaze.left == 0) return;
    const Eigen::Vector3d ahead = gaze.turn().col(2);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        auto node = mesh.row(nodes_[k]);
        const auto move = moves_.row(static_cast<Eigen::Index>(k));
        node += amount * move;
        if (rest_radius_[k] < ball_.size * EyeBall::kRadius || rest_radius_[k] > ball_.size * kLidReach)
            continue;
        const Eigen::Vector3d from = node.transpose() - ball_.centre;
        const double angle = std::acos(std::clamp(from.dot(ahead) / from.norm(), -1.0, 1.0));
        const double over = move.y() < 0 ? kLidOverLid * std::max(amount, 0.0) : 0;
        const double least = ball_.size * EyeBall::radius_at(angle) + kLidThickness + over;
        if (from.norm() < least) node = (ball_.centre + from * (least / from.norm())).transpose();
    }
}

}  // namespace viaface
