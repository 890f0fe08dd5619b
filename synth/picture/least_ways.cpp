#include "synth/picture/least_ways.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "synth/picture/layers.hpp"

namespace viaface {
namespace {

struct Band {
    double near, far;  // mm: from nothing to all
};
constexpr Band kFromLips{30, 80}, kFromEyes{10, 30};

struct Ball {
    Eigen::RowVector3d middle;
    double radius;
};

double risen(double distance, const Band& band) {
    const double x = std::clamp((distance - band.near) / (band.far - band.near), 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

std::vector<Ball> eyes_of(const Face& face) {
    std::vector<Ball> eyes;
    for (const FacePart& part : face.parts) {
        if (part.material != Material::kEye || part.nodes == 0) continue;
        const auto nodes = face.rest.middleRows(part.first_node, part.nodes);
        const Eigen::RowVector3d middle = nodes.colwise().mean();
        eyes.push_back({middle, (nodes.rowwise() - middle).rowwise().norm().maxCoeff()});
    }
    return eyes;
}

double from_lips(const Face& face, const Eigen::RowVector3d& place) {
    double least = kFromLips.far * kFromLips.far;
    for (int column = 0; column < LipGrid::kColumns; ++column)
        least = std::min(least, (face.rest.row(face.lips.node(0, column)) - place).squaredNorm());
    return std::sqrt(least);
}

double from_eyes(const std::vector<Ball>& eyes, const Eigen::RowVector3d& place) {
    double least = kFromEyes.far;
    for (const auto& [middle, radius] : eyes) least = std::min(least, (middle - place).norm() - radius);
    return least;
}

}  // namespace

Eigen::VectorXd least_ways(const Face& face, double pixel) {
    const Eigen::Index nodes = face.rest.rows();
    if (triangles_of(face, Material::kLips).empty())
        return Eigen::VectorXd::Constant(nodes, kLeastWay * pixel);
    const std::vector<Ball> eyes = eyes_of(face);
    Eigen::VectorXd far_off(nodes);
    for (Eigen::Index i = 0; i < nodes; ++i) {
        const Eigen::RowVector3d place = face.rest.row(i);
        far_off[i] = risen(from_lips(face, place), kFromLips) * risen(from_eyes(eyes, place), kFromEyes);
    }
    for (const FacePart& part : face.parts) {
        if (part.material != Material::kSkin && part.material != Material::kCloth)
            far_off.segment(part.first_node, part.nodes).setZero();
    }
    return pixel * (kLeastWay + (kLeastWayFarOff - kLeastWay) * far_off.array());
}

}  // namespace viaface
