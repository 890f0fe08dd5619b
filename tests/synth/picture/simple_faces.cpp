#include "simple_faces.hpp"

#include <cmath>
#include <numbers>

namespace viaface::testing {

void add_part(Face& face, Material material, const Nodes& nodes, const std::vector<Triangle>& triangles) {
    const int first = static_cast<int>(face.rest.rows()), count = static_cast<int>(nodes.rows());
    face.rest.conservativeResize(first + count, 3);
    face.rest.bottomRows(count) = nodes;
    face.uvs.conservativeResize(first + count, 2);
    face.uvs.bottomRows(count).setConstant(0.5f);
    for (int i = 0; i < count; ++i) face.weld.push_back(first + i);
    FacePart part{"part", material, Drive::kFixed, first, count, {}};
    for (const auto& [a, b, c] : triangles) part.triangles.push_back({first + a, first + b, first + c});
    face.parts.push_back(part);
}

void add_square(Face& face, Material material, double side, double nearer) {
    Nodes nodes(4, 3);
    const double h = side / 2, z = kMiddleZ + nearer;
    nodes << -h, kMiddleY - h, z, h, kMiddleY - h, z, h, kMiddleY + h, z, -h, kMiddleY + h, z;
    add_part(face, material, nodes, {{0, 1, 2}, {0, 2, 3}});
}

void add_ball(Face& face, Material material, double radius, const Eigen::Vector3d& middle, int rings) {
    const int segments = 2 * rings;
    Nodes nodes((rings + 1) * segments, 3);
    std::vector<Triangle> triangles;
    for (int ring = 0; ring <= rings; ++ring) {
        const double polar = std::numbers::pi * ring / rings;
        for (int s = 0; s < segments; ++s) {
            const double around = 2 * std::numbers::pi * s / segments;
            nodes.row(ring * segments + s) << middle.x() + radius * std::sin(polar) * std::sin(around),
                middle.y() + radius * std::cos(polar),
                middle.z() + radius * std::sin(polar) * std::cos(around);
            if (ring == rings) continue;
            const int a = ring * segments + s, b = ring * segments + (s + 1) % segments;
            triangles.push_back({a, a + segments, b + segments});
            triangles.push_back({a, b + segments, b});
        }
    }
    add_part(face, material, nodes, triangles);
}

}  // namespace viaface::testing
