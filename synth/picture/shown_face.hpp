// What a view shows of a face, as a face of its own: its nodes and those of a cut, fewer triangles and
// textures. The lower face is what lies nearer to the mouth than to the eyes at rest; the jaw is the skin
// that goes along when the mouth opens, and a rim round the lips.
#pragma once

#include "synth/picture/cut_face.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

// Whether the view shows all of a face as it is.
bool shows_all(const View& view);

CutFace shown_face(Face face, const View& view);

}  // namespace viaface
