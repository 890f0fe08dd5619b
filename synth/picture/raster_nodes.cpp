#include "synth/picture/raster_nodes.hpp"

#include <array>

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

template <int kRows>
void copy_rows(const Eigen::Matrix4d& from, float (&to)[kRows][4]) {
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < 4; ++column) to[row][column] = static_cast<float>(from(row, column));
    }
}

// All that the view alone tells.
raster::Placing placing_of(const View& view) {
    const Camera camera = camera_of(view);
    raster::Placing placing{};
    copy_rows(camera.world_from_head, placing.world_from_head);
    copy_rows(camera.clip_from_world, placing.clip_from_world);
    for (int i = 0; i < 3; ++i) placing.eye[i] = static_cast<float>(camera.place[i]);
    placing.half_width = 0.5f * view.width;
    placing.half_height = 0.5f * view.height;
    placing.far = static_cast<float>(1 / camera.place.z());
    placing.lashes_before = kLashesBefore;
    placing.orthographic = camera.orthographic;
    return placing;
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

RasterNodes::RasterNodes(const Face& face, const View& view, const raster::Kernel& kernel)
    : kernel_(kernel), of_view_(placing_of(view)), lash_(lashes_of(face)), nodes_(face.rest.rows()) {
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
    raster::Placing placing = of_view_;
    static_assert(sizeof(Vertex) == 8 * sizeof(float));
    placing.vertices = reinterpret_cast<const float*>(posed.vertices().data());
    placing.tangents = tangents_.data();
    placing.lash = lash_.data();
    placing.nodes = nodes_.data();
    pool.share_rows(int(nodes_.size()), [&](int first, int end, int) {
        std::array<std::int32_t, WorkPool::kRowsAtOnce> changed;
        int count = 0;
        for (int node = first; node < end; ++node) {
            if (!again || posed.changed(node)) changed[count++] = node;
        }
        kernel_.place(placing, changed.data(), count);
    });
}

}  // namespace viaface
