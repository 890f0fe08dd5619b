// Small letters for labels: capitals, five pixels wide and seven high.
#pragma once

#include <string_view>

#include "facemodel/face.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

// Width of the text, pixels, at so many pixels a dot.
int text_width(std::string_view text, int dot);

// Writes letters (of either case), hyphens and spaces; others are left blank. `left` and `top` count from the
// picture's upper left corner; what lies outside is left out.
void write_text(Texture& picture, std::string_view text, int left, int top, int dot, const Rgb& colour);

}  // namespace viaface
