// Another person's points as motion of a talker's:
//   p_talker(t) = rest_talker + S R (p(t) - rest_person),
// R the turn from the file's axes to the head frame, S = diag(sx, sy, sz): sx the talker's mouth width over
// the person's, sy likewise of the face height, sz their mean. Points keep their own ways; faces of other
// sizes and shapes meet at rest.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viapoints/face_axes.hpp"
#include "viapoints/rest.hpp"

namespace viaface {

struct PersonOptions {
    std::string axes = "found";                 // face_axes.hpp
    std::string up_axis = {};                   // of the file when it tells: "+Z"
    std::optional<TimeSpan> rest_s = {};        // else found
    std::vector<TimeSpan> quiet_s = {};         // when he does not speak, where it is known
    std::optional<Eigen::Vector3d> scale = {};  // else found
};

struct Person {
    FaceAxes axes;
    Rest rest;
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    std::string width_from, height_from;  // what was measured; empty: given, or not measurable
};

// Mouth width is that of the first pair of corners measured, or of one corner from the middle of the lips;
// face height that of nose or cheeks over chin or lower lip. What cannot be measured takes the other's scale.
// InputError("--axes"), ("--rest") or ("--scale") for what is not such, or cannot be found.
Person measure_person(const Motion& motion, const Configuration& talker_rest,
                      const PersonOptions& options = {});

// Of each axis over several recordings of one person, at least one: what each says of itself varies.
Eigen::Vector3d median_scale(const std::vector<Person>& recordings);

Motion as_talker(Motion motion, const Person& person, const Configuration& talker_rest);

}  // namespace viaface
