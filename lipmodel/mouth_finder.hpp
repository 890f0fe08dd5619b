// Where the mouth is below a pair of eyes: the red of the lips beside the skin around them, pseudo hue
// R / (R + G) [HurlbertPoggio88], cut in two by Otsu's threshold. Only a first place for the model, which is
// fitted afterwards.
#pragma once

#include "lipmodel/face_finder.hpp"

namespace viaface {

struct MouthInPicture {
    Eigen::Vector2d centre;        // px
    double width = 0, height = 0;  // px, along and across the line of the eyes

    bool operator==(const MouthInPicture&) const = default;
};

// Where mouths are under such eyes, whatever the colours.
MouthInPicture usual_mouth(const FaceInPicture& face);

MouthInPicture find_mouth(const Picture& picture, const FaceInPicture& face);

double pseudo_hue(const Rgb& colour);

}  // namespace viaface
