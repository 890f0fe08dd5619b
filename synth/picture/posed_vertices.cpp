#include "synth/picture/posed_vertices.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "synth/picture/key_shadow.hpp"
#include "synth/picture/least_ways.hpp"
#include "synth/picture/portrait.hpp"

namespace viaface {
namespace {

float grained(double mm) {
    return static_cast<float>(std::nearbyint(mm / Portrait::kGrain) * Portrait::kGrain);
}

// Pixels far outside stay numbers that an int can hold.
float within_reach(float pixel) {
    constexpr float kFar = 1e6f;
    return pixel > -kFar ? std::min(pixel, kFar) : -kFar;
}

Eigen::Matrix4f clip_from_head(const View& view) {
    const Camera camera = camera_of(view);
    return (camera.clip_from_world * camera.world_from_head).cast<float>();
}

}  // namespace

PosedVertices::PosedVertices(const Face& face, const View& view)
    : rest_(face.rest),
      least_ways_(least_ways(face, pixel_size(view))),
      node_normals_(face),
      mouth_light_(face),
      clip_from_head_(clip_from_head(view)),
      half_picture_(0.5f * view.width, 0.5f * view.height),
      places_(face.rest.rows(), 3),
      key_(key_shares(face, view)),
      vertices_(face.rest.rows()),
      kept_vertices_(face.rest.rows()),
      changed_(face.rest.rows()),
      pixels_(face.rest.rows()),
      kept_pixels_(face.rest.rows()) {}

void PosedVertices::place(const Nodes& posed) {
    for (Eigen::Index i = 0; i < posed.rows(); ++i) {
        const Eigen::RowVector3d way = posed.row(i) - rest_.row(i);
        const double share = drawn_share(way.squaredNorm(), least_ways_[i]);
        places_.row(i) = (rest_.row(i) + share * way).unaryExpr(&grained);
    }
}

void PosedVertices::pose(const Nodes& posed) {
    if (posed.rows() != places_.rows()) {
        throw std::invalid_argument("a pose of " + std::to_string(posed.rows()) + " nodes for a face of " +
                                    std::to_string(places_.rows()));
    }
    if (!posed.allFinite()) throw std::invalid_argument("a pose with places that are not finite");
    place(posed);
    node_normals_.compute(places_, normals_);
    mouth_light_.compute(places_, normals_, light_);
    for (Eigen::Index i = 0; i < places_.rows(); ++i) {
        vertices_[i] = {{places_(i, 0), places_(i, 1), places_(i, 2)},
                        {normals_(i, 0), normals_(i, 1), normals_(i, 2)},
                        light_[i],
                        key_[i]};
        changed_[i] = vertices_[i] != kept_vertices_[i];
        const Eigen::Vector4f clip = clip_from_head_ * places_.row(i).transpose().homogeneous();
        pixels_[i] = ((clip.head<2>() / clip.w()).array() + 1)
                         .matrix()
                         .cwiseProduct(half_picture_)
                         .unaryExpr(&within_reach);
    }
}

}  // namespace viaface
