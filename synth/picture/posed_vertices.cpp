#include "synth/picture/posed_vertices.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "synth/picture/key_shadow.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/least_ways.hpp"
#include "synth/picture/portrait.hpp"

namespace viaface {
namespace {

// To the nearest grain: beyond 2^52 doubles have no fractions, which rounds on the way there and back.
Eigen::RowVector3f grained(const Eigen::RowVector3d& mm) {
    constexpr double kWhole = 1.5 * (std::int64_t{1} << 52);
    return (((mm.array() / Portrait::kGrain + kWhole) - kWhole) * Portrait::kGrain).cast<float>();
}

NodesF grained_rest(const Face& face) {
    NodesF places(face.rest.rows(), 3);
    for (Eigen::Index i = 0; i < places.rows(); ++i) places.row(i) = grained(face.rest.row(i));
    return places;
}

std::vector<int> drawn_nodes(const Face& face) {
    std::vector<Triangle> all;
    for (const FacePart& part : face.parts)
        all.insert(all.end(), part.triangles.begin(), part.triangles.end());
    return nodes_of(all);
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
    : nodes_(drawn_nodes(face)),
      rest_(face.rest),
      least_ways_(least_ways(face, pixel_size(view))),
      node_normals_(face),
      mouth_(face, view.width, view.height),
      mouth_light_(face),
      clip_from_head_(clip_from_head(view)),
      half_picture_(0.5f * view.width, 0.5f * view.height),
      standing_(grained_rest(face)),
      places_(standing_),
      moved_(face.rest.rows()),
      turned_(face.rest.rows()),
      light_(face.rest.rows(), 1.0f),
      key_(key_shares(face, view)),
      vertices_(face.rest.rows()),
      changed_(face.rest.rows()),
      pixels_(face.rest.rows()),
      swept_(face.rest.rows()) {
    node_normals_.compute(places_, normals_);
    for (int node = 0; node < int(face.rest.rows()); ++node) {
        pixels_[node] = in_picture(node);
        turned_[node] = 1;
        finish(node);
    }
}

Eigen::Vector2f PosedVertices::in_picture(int node) const {
    const Eigen::Vector4f clip = clip_from_head_ * places_.row(node).transpose().homogeneous();
    return ((clip.head<2>() / clip.w()).array() + 1)
        .matrix()
        .cwiseProduct(half_picture_)
        .unaryExpr(&within_reach);
}

void PosedVertices::place(const Nodes& posed, int node) {
    const Eigen::RowVector3d way = posed.row(node) - rest_.row(node);
    const double share = drawn_share(way.squaredNorm(), least_ways_[node]);
    const Eigen::RowVector3f at =
        share > 0 ? grained(rest_.row(node) + share * way) : Eigen::RowVector3f(standing_.row(node));
    moved_[node] = at != places_.row(node);
    swept_[node] = Extent::of(pixels_[node]);
    if (moved_[node] == 0) return;
    places_.row(node) = at;
    pixels_[node] = in_picture(node);
    swept_[node] = both(swept_[node], Extent::of(pixels_[node]));
}

void PosedVertices::turn(int node) {
    turned_[node] = !mouth_.hidden(node) && (mouth_.uncovered(node) || node_normals_.turned(node));
    if (turned_[node] != 0) normals_.row(node) = node_normals_.of(node);
}

void PosedVertices::finish(int node) {
    Vertex& vertex = vertices_[node];
    changed_[node] = moved_[node];
    if ((moved_[node] | turned_[node]) == 0 && light_[node] == vertex.light) return;
    const Vertex before = vertex;
    vertex = {{places_(node, 0), places_(node, 1), places_(node, 2)},
              {normals_(node, 0), normals_(node, 1), normals_(node, 2)},
              light_[node],
              key_[node]};
    changed_[node] |= vertex != before;
}

void PosedVertices::pose(const Nodes& posed, WorkPool& pool) {
    if (posed.rows() != places_.rows()) {
        throw std::invalid_argument("a pose of " + std::to_string(posed.rows()) + " nodes for a face of " +
                                    std::to_string(places_.rows()));
    }
    const bool sum_is_finite = std::isfinite(posed.sum());  // quicker than to look at each
    if (!sum_is_finite && !posed.allFinite())
        throw std::invalid_argument("a pose with places that are not finite");
    const auto for_nodes = [&](const auto& work) {
        pool.share_rows(int(nodes_.size()), [&](int first, int end, int) {
            for (int i = first; i < end; ++i) work(nodes_[i]);
        });
    };
    for_nodes([&](int node) { place(posed, node); });
    const int triangles = node_normals_.triangles();
    pool.share(1 + WorkPool::pieces(triangles), [&](int item, int) {
        if (item == 0) return mouth_.look(pixels_, swept_);
        const int end = std::min(triangles, item * WorkPool::kRowsAtOnce);
        for (int i = (item - 1) * WorkPool::kRowsAtOnce; i < end; ++i) node_normals_.turn(i, places_, moved_);
    });
    for_nodes([&](int node) { turn(node); });
    mouth_light_.compute(places_, normals_, mouth_.nodes(), pool, light_);
    for_nodes([&](int node) { finish(node); });
}

}  // namespace viaface
