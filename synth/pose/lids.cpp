#include "synth/pose/lids.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

constexpr double kShutting = 1.12;      // the scan's lids stop 0.9 mm short of each other
constexpr double kLidThickness = 0.35;  // mm
constexpr double kLidReach = 22;        // mm: farther nodes are no lid

}  // namespace

Lids::Lids(const Face& face, const std::string& shape_name, double side) : ball_(eye_ball(side)) {
    const auto shape = std::find_if(face.shapes.begin(), face.shapes.end(),
                                    [&](const NamedShape& s) { return s.name == shape_name; });
    if (shape == face.shapes.end()) throw std::invalid_argument("the face has no shape " + shape_name);
    for (int i = 0; i < shape->delta.rows(); ++i) {
        if (shape->delta.row(i).norm() > 1e-3) nodes_.push_back(i);
    }
    moves_.resize(static_cast<Eigen::Index>(nodes_.size()), 3);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        moves_.row(static_cast<Eigen::Index>(k)) = kShutting * shape->delta.row(nodes_[k]);
        rest_radius_.push_back((face.rest.row(nodes_[k]).transpose() - ball_.centre).norm());
    }
}

void Lids::shut(Nodes& mesh, double amount) const {
    if (amount == 0) return;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        auto node = mesh.row(nodes_[k]);
        node += amount * moves_.row(static_cast<Eigen::Index>(k));
        if (rest_radius_[k] < EyeBall::kRadius || rest_radius_[k] > kLidReach) continue;
        const Eigen::Vector3d from = node.transpose() - ball_.centre;
        const double angle = std::acos(std::clamp(from.z() / from.norm(), -1.0, 1.0));
        const double least = EyeBall::radius_at(angle) + kLidThickness;
        if (from.norm() < least) node = (ball_.centre + from * (least / from.norm())).transpose();
    }
}

}  // namespace viaface
