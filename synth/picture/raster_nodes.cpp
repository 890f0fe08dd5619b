#include "synth/picture/raster_nodes.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "synth/picture/layers.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;

raster::Shade shade_of(Material material) {
    switch (material) {
        case Material::kSkin:
        case Material::kLips:
            return raster::Shade::kSkin;
        case Material::kMouth:
        case Material::kGums:
        case Material::kTeeth:
        case Material::kTongue:
            return raster::Shade::kInside;
        case Material::kEye:
            return raster::Shade::kEye;
        case Material::kLash:
            return raster::Shade::kLash;
        case Material::kCloth:
            return raster::Shade::kCloth;
    }
    return raster::Shade::kSkin;
}

std::vector<std::uint8_t> lashes_of(const Face& face) {
    std::vector<std::uint8_t> lash(face.rest.rows());
    for (const FacePart& part : face.parts) {
        if (part.material != Material::kLash) continue;
        for (const Triangle& triangle : part.triangles) {
            for (const int node : triangle) lash[node] = 1;
        }
    }
    return lash;
}

}  // namespace

std::vector<raster::Facet> facets_of(const Face& face) {
    std::vector<raster::Facet> facets;
    for (const auto& [material, triangles] : layers_of(face)) {
        for (const auto& [a, b, c] : triangles) {
            facets.push_back({{a, b, c},
                              0,
                              static_cast<std::uint8_t>(material),
                              shade_of(material),
                              inside_mouth(material),
                              two_sided(material),
                              material != Material::kSkin});
        }
    }
    while (facets.size() % raster::kFacetsAtOnce != 0)
        facets.push_back({{0, 0, 0}, 0, 0, raster::Shade::kCloth, false, false, false});
    return facets;
}

RasterNodes::RasterNodes(const Face& face, const View& view)
    : half_picture_(0.5f * view.width, 0.5f * view.height), lash_(lashes_of(face)), nodes_(face.rest.rows()) {
    const Camera camera = camera_of(view);
    orthographic_ = camera.orthographic;
    far_ = static_cast<float>(1 / camera.place.z());
    world_from_head_ = camera.world_from_head.cast<float>();
    clip_from_world_ = camera.clip_from_world.cast<float>();
    eye_ = camera.place.cast<float>();
    NodesF normals;
    NodeNormals(face).compute(face.rest.cast<float>(), normals);
    tangents_ = rest_tangents(face, normals);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        nodes_[i].s = face.uvs(i, 0);
        nodes_[i].t = 1 - face.uvs(i, 1);
        nodes_[i].side = tangents_(i, 3);
    }
}

void RasterNodes::place(const PosedVertices& posed, bool again, WorkPool& pool) {
    pool.share_rows(int(nodes_.size()), [&](int first, int end) {
        for (int node = first; node < end; ++node) {
            if (again && !posed.changed(node)) continue;
            place(posed.vertices()[node], node);
            if (!again || !posed.mouth().hidden(node)) light(posed.vertices()[node], node);
        }
    });
}

void RasterNodes::place(const Vertex& v, int i) {
    Vector3f world =
        world_from_head_.topLeftCorner<3, 3>() * Vector3f(v.place) + world_from_head_.topRightCorner<3, 1>();
    if (lash_[i]) world += kLashesBefore * (eye_ - world).normalized();
    nodes_[i].place = place_of(clip_from_world_ * world.homogeneous(), world.z());
}

void RasterNodes::light(const Vertex& v, int i) {
    const Eigen::Matrix3f turn = world_from_head_.topLeftCorner<3, 3>();
    const Vector3f normal(v.normal), tangent = tangents_.row(i).head<3>().transpose();
    const Vector3f along = (tangent - normal * normal.dot(tangent)).normalized();
    Vector3f::Map(nodes_[i].normal) = turn * normal;
    Vector3f::Map(nodes_[i].tangent) = turn * along;
    nodes_[i].light = v.light;
    nodes_[i].key = v.key;
}

raster::Place RasterNodes::place_of(const Eigen::Vector4f& clip, float height) const {
    const float shrink = 1 / clip.w();
    const float near = orthographic_ ? (1 + height * far_) * far_ : shrink;
    const Eigen::Vector2f from_middle = (clip.head<2>() * shrink).cwiseProduct(half_picture_);
    const bool can =
        clip.w() > 0 && std::abs(clip.z()) <= clip.w() && from_middle.cwiseAbs().maxCoeff() < raster::kGuard;
    if (!can) return {0, 0, 0};
    const Eigen::Vector2f at = (from_middle + half_picture_) * raster::kSteps;
    return {static_cast<std::int32_t>(std::lrint(at.x())), static_cast<std::int32_t>(std::lrint(at.y())),
            near};
}

}  // namespace viaface
