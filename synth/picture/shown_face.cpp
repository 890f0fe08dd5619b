#include "synth/picture/shown_face.hpp"

#include <algorithm>

#include "synth/picture/layers.hpp"

namespace viaface {
namespace {

constexpr double kWithJaw = 0.45;   // of the way of what moves most
constexpr double kRoundLips = 10;   // mm: skin that hides the mouth's lining from the side
constexpr double kUnderChin = -20;  // mm, z: what lies behind belongs to the neck

double mean_height(const Face& face, Material material) {
    double sum = 0, nodes = 0;
    for (const FacePart& part : face.parts) {
        if (part.material != material || part.nodes == 0) continue;
        sum += face.rest.middleRows(part.first_node, part.nodes).col(1).sum();
        nodes += part.nodes;
    }
    return nodes > 0 ? sum / nodes : 0;
}

std::vector<bool> below_middle(const Face& face) {
    const double border = (mean_height(face, Material::kLips) + mean_height(face, Material::kEye)) / 2;
    std::vector<bool> nodes(face.rest.rows());
    for (Eigen::Index i = 0; i < face.rest.rows(); ++i) nodes[i] = face.rest(i, 1) < border;
    return nodes;
}

bool near_lips(const Face& face, Eigen::Index node) {
    for (int column = 0; column < LipGrid::kColumns; ++column) {
        const auto border = face.rest.row(face.lips.node(0, column));
        if ((face.rest.row(node) - border).norm() < kRoundLips) return true;
    }
    return false;
}

std::vector<bool> on_jaw(const Face& face) {
    std::vector<bool> nodes(face.rest.rows(), false);
    const auto opens = std::ranges::find(face.shapes, "jawOpen", &NamedShape::name);
    if (opens == face.shapes.end()) return nodes;
    const Eigen::VectorXd ways = opens->delta.rowwise().norm();
    for (const FacePart& part : face.parts) {
        if (part.material != Material::kSkin || part.nodes == 0) continue;
        const double most = ways.segment(part.first_node, part.nodes).maxCoeff();
        for (int i = part.first_node; i < part.first_node + part.nodes; ++i)
            nodes[i] = (ways[i] > kWithJaw * most && face.rest(i, 2) > kUnderChin) || near_lips(face, i);
    }
    return nodes;
}

template <class Stays>
void keep_triangles(Face& face, const Stays& stays) {
    for (FacePart& part : face.parts)
        std::erase_if(part.triangles, [&](const Triangle& t) { return !stays(part.material, t); });
}

void keep(Face& face, Shown shown) {
    const std::vector<bool> nodes = shown == Shown::kLips ? on_jaw(face) : below_middle(face);
    keep_triangles(face, [&](Material material, const Triangle& t) {
        if (material == Material::kLips || inside_mouth(material)) return true;
        return material == Material::kSkin && std::ranges::all_of(t, [&](int node) { return nodes[node]; });
    });
}

// The lashes' texture is their shape.
void take_textures(Face& face) {
    for (int i = 0; i < kMaterials; ++i) {
        if (static_cast<Material>(i) != Material::kLash) face.surfaces[i] = {};
    }
}

}  // namespace

bool shows_all(const View& view) {
    return view.texture && view.shown != Shown::kLowerFace && view.shown != Shown::kLips;
}

Face shown_face(const Face& face, const View& view) {
    Face shown = face;
    if (!view.texture) take_textures(shown);
    if (view.shown == Shown::kLowerFace || view.shown == Shown::kLips) keep(shown, view.shown);
    return shown;
}

}  // namespace viaface
