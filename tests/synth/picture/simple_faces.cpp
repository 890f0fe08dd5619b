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

Face two_balls() {
    Face face;
    add_ball(face, Material::kSkin, 80, {0, kMiddleY, kMiddleZ}, 16);
    add_ball(face, Material::kTongue, 20, {0, kMiddleY - 30, kMiddleZ + 75}, 8);
    add_ball(face, Material::kEye, 12, {30, kMiddleY + 30, kMiddleZ + 70}, 8);
    add_ball(face, Material::kLash, 6, {30, kMiddleY + 45, kMiddleZ + 78}, 4);
    return face;
}

Texture waves(int side, int channels, double low, double high) {
    Texture texture{side, side, channels, {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (int c = 0; c < channels; ++c) {
                const double wave = std::sin(0.5 * x * (c + 1)) * std::cos(0.4 * y + c);
                texture.pixels.push_back(static_cast<std::uint8_t>(low + (high - low) * (0.5 + 0.5 * wave)));
            }
        }
    }
    return texture;
}

Face painted_balls() {
    Face face = two_balls();
    face.uvs.col(0) = (face.rest.col(0).array() / 90 + 0.3).cast<float>();
    face.uvs.col(1) = (face.rest.col(1).array() / 300 + 0.4).cast<float>();
    for (Surface& surface : face.surfaces) {
        surface = {waves(64, 3, 60, 240), waves(32, 3, 100, 255), waves(64, 3, 100, 156)};
    }
    face.surfaces[static_cast<int>(Material::kLash)].base_colour = waves(64, 4, 0, 255);
    return face;
}

Nodes wandering(const Face& face, int step) {
    Nodes posed = face.rest;
    const FacePart& tongue = face.parts[1];
    posed.middleRows(tongue.first_node, tongue.nodes).col(1).array() += 25 * std::sin(0.9 * step);
    posed.middleRows(tongue.first_node, tongue.nodes).col(0).array() += 0.3 * step;
    if (step % 3 == 0) {
        const FacePart& eye = face.parts[2];
        posed.middleRows(eye.first_node, eye.nodes).col(0).array() -= 5.0 * step;
    }
    return posed;
}

std::vector<std::uint8_t> bytes(const FrameView& view) {
    std::vector<std::uint8_t> all;
    for (int y = 0; y < view.height; ++y) {
        const std::uint8_t* row = view.top_row + y * view.stride;
        all.insert(all.end(), row, row + 4 * view.width);
    }
    return all;
}

}  // namespace viaface::testing
