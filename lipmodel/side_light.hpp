// Light from one side makes one half of a face darker and redder than the other, so that its skin looks like
// the lips of the lighter half. Faces are alike on both sides: the slope of a colour's logarithm across the
// face is the median over pairs of places that mirror each other under the eyes, and with it the lower face
// is evened before its colours are compared. The paper lights its talker from the front. A shadow's edge
// stays: no slope describes it.
#pragma once

#include <vector>

#include "lipmodel/face_finder.hpp"

namespace viaface {

struct SideLight {
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();  // of log R, G, B from left to right, per px
};

SideLight side_light(const Picture& picture, const FaceInPicture& face);

// Where the light counts from, and the way across the face.
struct FaceAxis {
    Eigen::Vector2d middle, along;  // px; unit
};

// [height x width x 3]: `picture`, evened within the box.
std::vector<std::uint8_t> evened(const Picture& picture, const PictureBox& box, const SideLight& light,
                                 const FaceAxis& axis);

}  // namespace viaface
