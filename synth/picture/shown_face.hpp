// What a view shows of a face, as a face of its own: the same nodes, fewer triangles and textures. The lower
// face is what lies nearer to the mouth than to the eyes at rest; the jaw is the skin that goes along when
// the mouth opens, and a rim round the lips. The cuts run along edges of triangles.
#pragma once

#include "facemodel/face.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

// Whether the view shows all of a face as it is.
bool shows_all(const View& view);

Face shown_face(const Face& face, const View& view);

}  // namespace viaface
