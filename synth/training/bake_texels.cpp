#include "synth/training/bake_texels.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "synth/picture/surface_frame.hpp"

namespace viaface {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

struct Frames {
    NodesF places, normals;
    Tangents tangents;
};

Frames frames_of(const Face& face) {
    Frames frames;
    frames.places = face.rest.cast<float>();
    NodeNormals(face).compute(frames.places, frames.normals);
    frames.tangents = rest_tangents(face, frames.normals);
    return frames;
}

float cross(const Vector2f& a, const Vector2f& b) { return a.x() * b.y() - a.y() * b.x(); }

Texel mix(const Frames& frames, const Triangle& t, const Vector3f& share) {
    Texel texel;
    Vector3f tangent = Vector3f::Zero();
    texel.place.setZero();
    texel.normal.setZero();
    for (int k = 0; k < 3; ++k) {
        texel.place += share[k] * frames.places.row(t[k]).transpose();
        texel.normal += share[k] * frames.normals.row(t[k]).transpose();
        tangent += share[k] * frames.tangents.row(t[k]).head<3>().transpose();
    }
    texel.normal.normalize();
    texel.along_u = (tangent - texel.normal * texel.normal.dot(tangent)).normalized();
    texel.along_v = texel.normal.cross(texel.along_u) * frames.tangents(t[0], 3);
    return texel;
}

void fill(TexelGrid& grid, const Face& face, const Frames& frames, const Triangle& t, int part) {
    const float side = static_cast<float>(grid.side);
    Vector2f corner[3];
    for (int k = 0; k < 3; ++k) {
        corner[k] = {face.uvs(t[k], 0) * side - 0.5f, (1 - face.uvs(t[k], 1)) * side - 0.5f};
    }
    const float twice_area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    if (twice_area == 0) return;
    const auto [left, right] = std::minmax({corner[0].x(), corner[1].x(), corner[2].x()});
    const auto [top, bottom] = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
    for (int y = std::max(0, int(std::ceil(top))); y <= std::min(grid.side - 1, int(bottom)); ++y) {
        for (int x = std::max(0, int(std::ceil(left))); x <= std::min(grid.side - 1, int(right)); ++x) {
            Texel& texel = grid.texels[std::size_t(y) * grid.side + x];
            const Vector2f at(static_cast<float>(x), static_cast<float>(y));
            Vector3f share;
            for (int k = 0; k < 3; ++k) {
                const Vector2f& from = corner[(k + 1) % 3];
                share[k] = cross(corner[(k + 2) % 3] - from, at - from) / twice_area;
            }
            if (share.minCoeff() < -1e-4f || texel.part >= 0) continue;
            texel = mix(frames, t, share);
            texel.u = (at.x() + 0.5f) / side;
            texel.v = 1 - (at.y() + 0.5f) / side;
            texel.part = part;
        }
    }
}

}  // namespace

TexelGrid lay_out(const Face& face, Material material, int side) {
    TexelGrid grid{side, std::vector<Texel>(std::size_t(side) * side)};
    const Frames frames = frames_of(face);
    for (std::size_t part = 0; part < face.parts.size(); ++part) {
        if (face.parts[part].material != material) continue;
        for (const Triangle& t : face.parts[part].triangles) fill(grid, face, frames, t, int(part));
    }
    return grid;
}

void spread(Texture& texture, const TexelGrid& grid, int reach) {
    const int side = grid.side, channels = texture.channels;
    std::vector<char> painted(grid.texels.size());
    std::ranges::transform(grid.texels, painted.begin(), [](const Texel& t) { return t.part >= 0; });
    constexpr int kWays[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    for (int step = 0; step < reach; ++step) {
        const std::vector<char> before = painted;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const std::size_t at = std::size_t(y) * side + x;
                for (int way = 0; way < 8 && !painted[at]; ++way) {
                    const int nx = x + kWays[way][0], ny = y + kWays[way][1];
                    if (nx < 0 || ny < 0 || nx >= side || ny >= side) continue;
                    const std::size_t from = std::size_t(ny) * side + nx;
                    if (!before[from]) continue;
                    std::copy_n(&texture.pixels[from * channels], channels, &texture.pixels[at * channels]);
                    painted[at] = 1;
                }
            }
        }
    }
}

}  // namespace viaface
