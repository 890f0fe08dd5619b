// What is known of a talker's mouth once the first pictures of him have been seen (first_pictures.hpp), and
// the most probable lips in a picture by it.
#pragma once

#include <limits>
#include <optional>

#include "lipmodel/closed_lips.hpp"
#include "lipmodel/lip_ascent.hpp"
#include "lipmodel/side_light.hpp"

namespace viaface {

// mm per px at the lips' depth, and where the head's origin then is.
struct Placing {
    Pinhole camera;
    double px_per_mm;
    Eigen::Vector3d lips_centre;  // of the mean shape's border, model frame

    // The lips' centre at a place in the picture, px; shrink: of what px_per_mm says.
    LipPose pose(const Eigen::Vector2d& centre, double roll, double shrink,
                 const Eigen::Vector3d& scale) const;
    Eigen::Vector2d centre_of(const LipPose& pose) const;  // px
};

// Within the picture.
PictureBox box_about(const Picture& picture, const Eigen::Vector2d& centre, double half_width,
                     double half_height);

struct ProbableLips {
    Eigen::VectorXd p = {};
    LipPose pose = {};
    double log_posterior = -std::numeric_limits<double>::infinity(), confidence = 0;
    int iterations = 0;
};

struct KnownMouth {
    LipModel model;  // with thickness
    ClosedLips closed;
    AscentOptions ascent;
    Placing placing = {};
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // of the model's x, y and z
    double width_px = 0;                              // when it was found
    Eigen::Vector2d below_eyes = {0, 1.1};            // in distances of the eyes: across, down
    SideLight light = {};
    std::optional<ColourClasses> classes = {};

    Eigen::VectorXd still() const { return Eigen::VectorXd::Zero(model.modes.cols()); }
    PictureBox box(const Picture& picture, const Eigen::Vector2d& centre) const;
    // From each start; then, from the best, with the lips shut.
    ProbableLips most_probable(const Picture& evened, const PictureBox& box, const LipPose& expected,
                               const PoseFreedom& freedom, const std::vector<Eigen::VectorXd>& starts) const;
};

}  // namespace viaface
