#include "synth/picture/surface_frame.hpp"

#include <Eigen/Geometry>

namespace viaface {
namespace {

using Eigen::RowVector2f;
using Eigen::RowVector3f;

RowVector3f triangle_tangent(const Face& face, const Triangle& t, RowVector3f& bitangent) {
    const RowVector3f e1 = (face.rest.row(t[1]) - face.rest.row(t[0])).cast<float>();
    const RowVector3f e2 = (face.rest.row(t[2]) - face.rest.row(t[0])).cast<float>();
    const RowVector2f d1 = face.uvs.row(t[1]) - face.uvs.row(t[0]);
    const RowVector2f d2 = face.uvs.row(t[2]) - face.uvs.row(t[0]);
    const float side = d1.x() * d2.y() - d2.x() * d1.y() < 0 ? -1.0f : 1.0f;
    bitangent = side * (e2 * d1.x() - e1 * d2.x());
    return side * (e1 * d2.y() - e2 * d1.y());
}

}  // namespace

NodeNormals::NodeNormals(const Face& face) : weld_(face.weld) {
    for (const FacePart& part : face.parts) {
        for (const Triangle& t : part.triangles) {
            triangles_.push_back({weld_[t[0]], weld_[t[1]], weld_[t[2]]});
        }
    }
}

void NodeNormals::compute(const NodesF& places, NodesF& normals) const {
    normals.setZero(places.rows(), 3);
    for (const auto& [a, b, c] : triangles_) {
        const RowVector3f at = places.row(a);
        const RowVector3f twice_area = (places.row(b) - at).cross(places.row(c) - at);
        normals.row(a) += twice_area;
        normals.row(b) += twice_area;
        normals.row(c) += twice_area;
    }
    for (Eigen::Index node = 0; node < places.rows(); ++node) {
        const int first = weld_[node];
        if (first != node) {
            normals.row(node) = normals.row(first);
            continue;
        }
        const float length = normals.row(node).norm();
        if (length > 0) {
            normals.row(node) /= length;
        } else {
            normals.row(node) = RowVector3f::UnitZ();
        }
    }
}

Tangents rest_tangents(const Face& face, const NodesF& normals) {
    NodesF along_u = NodesF::Zero(face.rest.rows(), 3), along_v = along_u;
    for (const FacePart& part : face.parts) {
        for (const Triangle& t : part.triangles) {
            RowVector3f bitangent;
            const RowVector3f tangent = triangle_tangent(face, t, bitangent);
            for (const int node : t) {
                along_u.row(node) += tangent;
                along_v.row(node) += bitangent;
            }
        }
    }
    Tangents tangents(face.rest.rows(), 4);
    for (Eigen::Index node = 0; node < tangents.rows(); ++node) {
        const RowVector3f normal = normals.row(node);
        RowVector3f tangent = along_u.row(node) - normal * normal.dot(along_u.row(node));
        if (!(tangent.norm() > 0)) tangent = normal.unitOrthogonal();
        tangent.normalize();
        const float sign = normal.cross(tangent).dot(along_v.row(node)) < 0 ? -1.0f : 1.0f;
        tangents.row(node).head<3>() = tangent;
        tangents(node, 3) = sign;
    }
    return tangents;
}

}  // namespace viaface
