// What turns a pose into pixels: our own rasteriser, or OpenGL, which stands as the reference.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "synth/picture/packed_textures.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/picture/posed_vertices.hpp"
#include "synth/picture/rect.hpp"

namespace viaface {

class Painter {
  public:
    virtual ~Painter() = default;
    // Draws the rectangles, which are apart from each other, into `rgba`: [height x width x 4], bottom row
    // first. Nothing inside the mouth shows outside its opening. With `again`, `rgba` holds what was painted
    // last and all that `posed` calls unchanged is as it was then: every pose is painted, if only nowhere.
    virtual void paint(const PosedVertices& posed, std::span<const Rect> rects, bool again,
                       std::uint8_t* rgba) = 0;
};

// Of a face its surfaces are not asked for.
std::unique_ptr<Painter> make_wire_painter(const Face& face, const View& view);
std::unique_ptr<Painter> make_gl_painter(const Face& face, const Surfaces& surfaces, const View& view);
std::unique_ptr<Painter> make_raster_painter(const Face& face, const Surfaces& surfaces, const View& view,
                                             Instructions widest, WorkPool& pool);

}  // namespace viaface
