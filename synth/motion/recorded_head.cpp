#include "synth/motion/recorded_head.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth/pose/head_sway.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

const std::vector<double>* column_of(const Motion& motion, std::string_view name) {
    for (const ExtraColumn& column : motion.extra)
        if (in_lower_case(column.name) == name) return &column.values;
    return nullptr;
}

// Of every sample; what is missing is as before, 0 at first.
std::vector<double> angles_of(const Motion& motion, std::string_view name) {
    std::vector<double> angles(motion.size());
    const auto* column = column_of(motion, name);
    double last = 0;
    for (std::size_t i = 0; column && i < angles.size(); ++i) {
        if (std::isfinite((*column)[i])) last = (*column)[i];
        angles[i] = last;
    }
    return angles;
}

Eigen::Isometry3d about_neck(const Eigen::Quaterniond& turn) {
    return Eigen::Translation3d(kNeckPivot) * turn * Eigen::Translation3d(-kNeckPivot);
}

}  // namespace

std::vector<Eigen::Isometry3d> recorded_head(const Motion& motion) {
    const auto yaw = angles_of(motion, "headyaw"), pitch = angles_of(motion, "headpitch"),
               roll = angles_of(motion, "headroll");
    const auto turn_at = [&](std::size_t i) -> Eigen::Quaterniond {
        return AngleAxisd(yaw[i], Vector3d::UnitY()) * AngleAxisd(pitch[i], Vector3d::UnitX()) *
               AngleAxisd(roll[i], Vector3d::UnitZ());
    };
    std::vector<Eigen::Isometry3d> head;
    for (std::size_t i = 0; i < motion.size(); ++i)
        head.push_back(about_neck(turn_at(0).conjugate() * turn_at(i)));
    if (widest_turn_degrees(head) == 0) head.clear();
    return head;
}

double widest_turn_degrees(const std::vector<Eigen::Isometry3d>& head) {
    double widest = 0;
    for (const Eigen::Isometry3d& turned : head)
        widest = std::max(widest, AngleAxisd(turned.linear()).angle() * 180 / std::numbers::pi);
    return widest;
}

}  // namespace viaface
