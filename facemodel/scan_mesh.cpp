#include "facemodel/scan_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "base/error.hpp"

namespace viaface {
namespace {

[[noreturn]] void refuse(const std::string& value, const std::string& allowed) {
    throw InputError("scan", value, allowed);
}

void check_indices(const std::vector<Triangle>& triangles, Eigen::Index count, const std::string& what) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const int i : triangles[t]) {
            if (i < 0 || i >= count)
                refuse("triangle " + std::to_string(t) + ": " + what + " " + std::to_string(i),
                       "0 to " + std::to_string(count - 1));
        }
    }
}

int root_of(std::vector<int>& parent, int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
}

}  // namespace

void add_polygon(ScanMesh& mesh, const std::vector<int>& corners, const std::vector<int>& uvs) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
        if (!uvs.empty()) mesh.uv_triangles.push_back({uvs[0], uvs[k - 1], uvs[k]});
    }
}

void add_strip(ScanMesh& mesh, const std::vector<int>& corners) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
        const bool odd = k % 2 == 1;
        mesh.triangles.push_back({corners[k - 2], corners[odd ? k : k - 1], corners[odd ? k - 1 : k]});
    }
}

void share_uvs_with_nodes(ScanMesh& mesh) { mesh.uv_triangles = mesh.triangles; }

void check(const ScanMesh& mesh) {
    if (mesh.nodes.rows() == 0) refuse("no nodes", "a surface");
    if (mesh.triangles.empty()) refuse("no triangles", "a surface: nodes joined by polygons");
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
        if (!mesh.nodes.row(i).allFinite()) refuse("node " + std::to_string(i), "finite coordinates");
    }
    for (Eigen::Index i = 0; i < mesh.uvs.rows(); ++i) {
        if (!mesh.uvs.row(i).allFinite())
            refuse("texture coordinate " + std::to_string(i), "finite coordinates");
    }
    check_indices(mesh.triangles, mesh.nodes.rows(), "node");
    check_indices(mesh.uv_triangles, mesh.uvs.rows(), "texture coordinate");
    if (!mesh.uv_triangles.empty() && mesh.uv_triangles.size() != mesh.triangles.size())
        refuse("texture coordinates on some polygons", "on all of them, or on none");
}

ScanMesh scan_mesh(const ObjScan& scan) {
    ScanMesh mesh;
    mesh.nodes = scan.nodes;
    mesh.uvs = scan.uvs;
    const bool mapped = !scan.faces.empty() &&
                        std::ranges::all_of(scan.faces, [](const ObjFace& f) { return f.uvs[0] >= 0; });
    for (const ObjFace& face : scan.faces) {
        const std::size_t count = face.nodes[3] < 0 ? 3 : 4;
        add_polygon(
            mesh, {face.nodes.begin(), face.nodes.begin() + count},
            mapped ? std::vector<int>{face.uvs.begin(), face.uvs.begin() + count} : std::vector<int>{});
    }
    check(mesh);
    return mesh;
}

ScanMesh thinned(const ScanMesh& mesh, double cell) {
    std::unordered_map<std::uint64_t, int> kept_in;
    std::vector<int> new_index(static_cast<std::size_t>(mesh.nodes.rows()));
    std::vector<Eigen::Index> kept;
    const Eigen::RowVector3d low = mesh.nodes.colwise().minCoeff();
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
        const Eigen::RowVector3d place = (mesh.nodes.row(i) - low) / cell;
        std::uint64_t key = 0;
        for (int k = 0; k < 3; ++k) key = key << 21 | (static_cast<std::uint64_t>(place[k]) & 0x1fffff);
        const auto [found, added] = kept_in.try_emplace(key, static_cast<int>(kept.size()));
        if (added) kept.push_back(i);
        new_index[static_cast<std::size_t>(i)] = found->second;
    }
    ScanMesh thin;
    thin.nodes = mesh.nodes(kept, Eigen::all);
    thin.uvs = mesh.uvs;
    thin.pictures = mesh.pictures;
    thin.picture = mesh.picture;
    if (!mesh.colours.empty()) {
        for (const auto i : kept) thin.colours.push_back(mesh.colours[static_cast<std::size_t>(i)]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle moved = mesh.triangles[t];
        for (int& node : moved) node = new_index[static_cast<std::size_t>(node)];
        if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
        thin.triangles.push_back(moved);
        if (!mesh.uv_triangles.empty()) thin.uv_triangles.push_back(mesh.uv_triangles[t]);
    }
    return thin;
}

std::vector<std::vector<int>> pieces_of(const ScanMesh& mesh) {
    std::vector<int> parent(static_cast<std::size_t>(mesh.nodes.rows()));
    std::iota(parent.begin(), parent.end(), 0);
    for (const Triangle& t : mesh.triangles) {
        for (int k = 1; k < 3; ++k) parent[root_of(parent, t[k])] = root_of(parent, t[0]);
    }
    std::vector<int> piece_of(parent.size(), -1);
    std::vector<std::vector<int>> pieces;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        int& piece = piece_of[root_of(parent, mesh.triangles[t][0])];
        if (piece < 0) {
            piece = static_cast<int>(pieces.size());
            pieces.emplace_back();
        }
        pieces[piece].push_back(static_cast<int>(t));
    }
    std::ranges::stable_sort(pieces, [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return pieces;
}

}  // namespace viaface
