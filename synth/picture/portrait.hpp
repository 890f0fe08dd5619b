// Pictures of one face from one view. Lights, camera and textures are set up once; then each pose of the face
// is drawn, and only where it differs from the pose before: the picture is the same, byte for byte, as if
// it had been drawn whole. A Portrait serves one thread at a time; several Portraits are independent.
// A node's place is rounded to kGrain, and what is hardly off its rest stands still (least_ways.hpp); the way
// from standing to moving has no step.
#pragma once

#include <memory>

#include "facemodel/face.hpp"
#include "synth/film/frame.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

enum class Renderer {
    kRaster,  // our own rasteriser
    kOsmesa   // Mesa's, the reference: some ten times slower
};

// Of the rasteriser, from what every processor has to the widest; the same bytes with any.
enum class Instructions { kBaseline, kAvx2, kAvx512 };

struct Drawing {
    Renderer renderer = Renderer::kRaster;
    int threads = 2;  // of the rasteriser, the caller's included; the same bytes with any number
    Instructions widest = Instructions::kAvx512;  // that may be taken, where the processor has them
};

class Portrait {
  public:
    static constexpr double kGrain = 1.0 / 64;  // mm

    enum class Redraw { kChanged, kAll };

    // InputError for a view out of its limits; std::invalid_argument for a face whose arrays do not fit.
    Portrait(const Face& face, const View& view, const Drawing& drawing = {});
    ~Portrait();
    Portrait(Portrait&&) noexcept;
    Portrait& operator=(Portrait&&) noexcept;

    // `posed` is [nodes of the face x 3], mm, head frame. The picture stays until the next call.
    FrameView draw(const Nodes& posed, Redraw redraw = Redraw::kChanged);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace viaface
