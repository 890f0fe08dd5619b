// A frame as the lip tracker looks at it: without alpha, and where the face is large, smaller by a whole
// factor, each pixel the mean of its square. [Basu98]'s mouths are about 80 px wide, and more tells no more.
#pragma once

#include "lipmodel/colour_classes.hpp"
#include "synth/film/frame.hpp"

namespace viaface {

struct SmallPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb = {};

    Picture picture() const { return {width, height, rgb}; }
};

SmallPicture small_picture(const Frame& frame, int factor);  // factor: 1 or more

// Between the two: px of the frame from px of the small picture.
inline double in_frame(double small_px, int factor) { return (small_px + 0.5) * factor - 0.5; }
inline double in_small(double frame_px, int factor) { return (frame_px + 0.5) / factor - 0.5; }

}  // namespace viaface
