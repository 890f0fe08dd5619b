// The head's turns as a Live Link Face recording tells them beside its weights: HeadYaw, HeadPitch and
// HeadRoll in radians, right-handed about the head frame's y, x and z (to the talker's left, chin down,
// towards his right ear), yaw outermost:
//   R = R_y(yaw) R_x(pitch) R_z(roll).
// They turn about the neck (head_sway.hpp) and count from the first sample. Where a turn is missing the head
// stays.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

// [samples], where the head of the first sample has gone, mm, head frame; none without such columns, or where
// the head never turns.
std::vector<Eigen::Isometry3d> recorded_head(const Motion& motion);

// Degrees, of the turn farthest from the first one.
double widest_turn_degrees(const std::vector<Eigen::Isometry3d>& head);

}  // namespace viaface
