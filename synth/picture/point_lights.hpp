// Point lights: places of the face as white dots, as if the head were of glass. A dot is round, of kRadius at
// the picture's middle, and its middle is where the place falls.
#pragma once

#include <span>
#include <vector>

#include "synth/film/frame.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

class PointLights {
  public:
    static constexpr double kRadius = 1.6;    // mm
    static constexpr double kSmallest = 1.5;  // pixels

    explicit PointLights(const View& view);  // InputError as camera_of throws it

    // mm, head frame. The picture stays until the next call.
    FrameView draw(std::span<const Eigen::Vector3d> places);

  private:
    View view_;
    Eigen::Matrix4d clip_from_head_;
    float radius_;  // pixels
    std::vector<std::uint8_t> background_, rgba_;
};

}  // namespace viaface
