#include "synth/picture/shown_face.hpp"

#include <algorithm>
#include <cmath>

#include "synth/picture/layers.hpp"

namespace viaface {
namespace {

constexpr double kWithJaw = 0.45;   // of the way of what moves most
constexpr double kJawHeight = 60;   // mm over which skin comes to go all the way
constexpr double kRoundLips = 10;   // mm: skin that hides the mouth's lining from the side
constexpr double kUnderChin = -20;  // mm, z: what lies behind belongs to the neck
constexpr double kRound = 8;        // mm: how round corners of the cut are

double mean_height(const Face& face, Material material) {
    double sum = 0, nodes = 0;
    for (const FacePart& part : face.parts) {
        if (part.material != material || part.nodes == 0) continue;
        sum += face.rest.middleRows(part.first_node, part.nodes).col(1).sum();
        nodes += part.nodes;
    }
    return nodes > 0 ? sum / nodes : 0;
}

// How far below the middle between eyes and lips, mm.
Eigen::VectorXd below_middle(const Face& face) {
    const double border = (mean_height(face, Material::kLips) + mean_height(face, Material::kEye)) / 2;
    return border - face.rest.col(1).array();
}

double to_lips(const Face& face, Eigen::Index node) {
    double least = 1e9;
    for (int column = 0; column < LipGrid::kColumns; ++column) {
        const auto border = face.rest.row(face.lips.node(0, column));
        least = std::min(least, (face.rest.row(node) - border).norm());
    }
    return least;
}

// The larger of two distances, or more where they are alike.
double either(double a, double b) { return (a + b + std::hypot(a - b, kRound)) / 2; }
double both_of(double a, double b) { return -either(-a, -b); }

// Of each node when the mouth opens, as part of what moves most.
Eigen::VectorXd ways_with_jaw(const Face& face) {
    const auto opens = std::ranges::find(face.shapes, "jawOpen", &NamedShape::name);
    if (opens == face.shapes.end()) return Eigen::VectorXd::Zero(face.rest.rows());
    const Eigen::VectorXd ways = opens->delta.rowwise().norm();
    double most = 1e-9;
    for (const FacePart& part : face.parts) {
        if (part.material == Material::kSkin && part.nodes > 0)
            most = std::max(most, ways.segment(part.first_node, part.nodes).maxCoeff());
    }
    return ways / most;
}

// How far within the skin that goes with the jaw or lies round the lips, about mm.
Eigen::VectorXd on_jaw(const Face& face) {
    const Eigen::VectorXd ways = ways_with_jaw(face);
    Eigen::VectorXd within(face.rest.rows());
    for (Eigen::Index i = 0; i < within.size(); ++i) {
        const double jaw = both_of(kJawHeight * (ways[i] - kWithJaw), face.rest(i, 2) - kUnderChin);
        within[i] = either(jaw, kRoundLips - to_lips(face, i));
    }
    return within;
}

bool of_mouth(Material material) { return material == Material::kLips || inside_mouth(material); }

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

CutFace shown_face(Face face, const View& view) {
    if (!view.texture) take_textures(face);
    if (view.shown != Shown::kLowerFace && view.shown != Shown::kLips) return {std::move(face), {}};
    const Eigen::VectorXd field = view.shown == Shown::kLips ? on_jaw(face) : below_middle(face);
    return cut_skin(std::move(face), field, &of_mouth);
}

}  // namespace viaface
