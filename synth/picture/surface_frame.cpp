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

NodeNormals::NodeNormals(const Face& face) {
    for (const FacePart& part : face.parts) {
        for (const Triangle& t : part.triangles)
            triangles_.push_back({face.weld[t[0]], face.weld[t[1]], face.weld[t[2]]});
    }
    doubled_areas_.resize(triangles_.size());
    turned_.resize(triangles_.size());
    std::vector<std::vector<int>> adjoining(face.weld.size());
    for (int i = 0; i < int(triangles_.size()); ++i) {
        for (const int node : triangles_[i]) adjoining[node].push_back(i);
    }
    for (const int first : face.weld) {
        first_adjoining_.push_back(int(adjoining_.size()));
        adjoining_.insert(adjoining_.end(), adjoining[first].begin(), adjoining[first].end());
        end_adjoining_.push_back(int(adjoining_.size()));
    }
}

void NodeNormals::compute(const NodesF& places, NodesF& normals) {
    normals.resize(places.rows(), 3);
    const std::vector<std::uint8_t> all(places.rows(), 1);
    for (int i = 0; i < triangles(); ++i) turn(i, places, all);
    for (int node = 0; node < int(places.rows()); ++node) normals.row(node) = of(node);
}

void NodeNormals::take_in(int triangle, const NodesF& places) {
    const auto& [a, b, c] = triangles_[triangle];
    const RowVector3f from = places.row(a);
    const RowVector3f area = (places.row(b) - from).cross(places.row(c) - from);
    doubled_areas_[triangle] = {area.x(), area.y(), area.z(), 0};
}

RowVector3f NodeNormals::of(int node) const {
    Eigen::RowVector4f sum = Eigen::RowVector4f::Zero();
    for (int i = first_adjoining_[node]; i < end_adjoining_[node]; ++i) sum += doubled_areas_[adjoining_[i]];
    const float length = sum.head<3>().norm();
    return length > 0 ? RowVector3f(sum.head<3>() / length) : RowVector3f::UnitZ();
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
