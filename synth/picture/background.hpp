// What stands behind the head, made once per view: one colour, or a soft grey glow with a dither of one step
// so that no bands show.
#pragma once

#include "facemodel/face.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

Texture make_background(const View& view);  // [height x width x 4], bottom row first, sRGB

}  // namespace viaface
