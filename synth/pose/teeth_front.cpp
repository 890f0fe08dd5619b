#include "synth/pose/teeth_front.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {

TeethFront teeth_front(const Nodes& rest, const FacePart& teeth, double side) {
    constexpr double kFrontHalf = 15, kMiddleHalf = 4, kVisible = 8;  // mm
    TeethFront front{-1e9, 0, side * 1e9, side, 2.0};
    for (int i = teeth.first_node; i < teeth.first_node + teeth.nodes; ++i) {
        if (std::abs(rest(i, 0)) > kMiddleHalf) continue;
        if (side * rest(i, 1) < side * front.edge_y) front.edge_y = rest(i, 1);
    }
    const auto crown = [&](int i) { return side * (rest(i, 1) - front.edge_y) < kVisible; };
    for (int i = teeth.first_node; i < teeth.first_node + teeth.nodes; ++i) {
        if (crown(i) && std::abs(rest(i, 0)) < kMiddleHalf)
            front.front_z = std::max(front.front_z, rest(i, 2));
    }
    double least = 1e9;
    for (int i = teeth.first_node; i < teeth.first_node + teeth.nodes; ++i) {
        const double x = rest(i, 0);
        if (!crown(i) || std::abs(x) < kMiddleHalf || std::abs(x) > kFrontHalf) continue;
        least = std::min(least, (front.front_z - rest(i, 2)) / (x * x));
    }
    front.curvature = std::max(least, 0.0);
    return front;
}

TeethFront moved_front(TeethFront front, const JawMotion& jaw) {
    const Eigen::Vector3d edge(0, front.edge_y, front.front_z), now = jaw(edge);
    front.edge_y = now.y();
    front.front_z = now.z();
    return front;
}

}  // namespace viaface
