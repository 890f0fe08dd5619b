#include "lipmodel/coloured_faces.hpp"

#include <algorithm>

namespace viaface {
namespace {

void add_opening(std::vector<ColouredFace>& faces) {
    const auto inner = [](int column) { return LipMesh::node(LipMesh::kInnerRing, column); };
    for (int column = -LipMesh::kLeftCorner; column < LipMesh::kLeftCorner; ++column) {
        const int upper = inner(column), next_upper = inner(column + 1);
        const int lower = inner(LipMesh::kBottom - column), next_lower = inner(LipMesh::kBottom - column - 1);
        if (upper != lower) faces.push_back({{upper, lower, next_lower}, ColourClass::kOpening});
        if (next_upper != next_lower)
            faces.push_back({{upper, next_lower, next_upper}, ColourClass::kOpening});
    }
}

std::vector<ColouredFace> faces_of_the_mesh() {
    const LipMesh mesh = generic_lip_mesh();
    std::vector<ColouredFace> faces;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.regions[i] == LipRegion::kStrip) continue;
        const bool lips = mesh.regions[i] == LipRegion::kLips;
        faces.push_back({mesh.triangles[i], lips ? ColourClass::kLips : ColourClass::kSkin});
    }
    add_opening(faces);
    return faces;
}

}  // namespace

const std::vector<ColouredFace>& coloured_faces() {
    static const std::vector<ColouredFace> faces = faces_of_the_mesh();
    return faces;
}

// In the picture y points down.
double visible_area(const Pixels& pixels, const Triangle& t) {
    const Eigen::RowVector2d along = pixels.row(t[1]) - pixels.row(t[0]),
                             up = pixels.row(t[2]) - pixels.row(t[0]);
    return std::max(0.0, 0.5 * (up.x() * along.y() - up.y() * along.x()));
}

}  // namespace viaface
