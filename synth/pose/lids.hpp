// The lids, which slide over the eyeball when the eye blinks and follow it when it looks up or down.
#pragma once

#include <string>
#include <vector>

#include "facemodel/face.hpp"
#include "synth/pose/eye_ball.hpp"

namespace viaface {

// The nodes that one eye's blink moves, and by how much. The upper lid comes to lie over the lower one.
class Lids {
  public:
    // shape: of the face, the shut eye; side: +1 the talker's left. std::invalid_argument when the face lacks
    // it.
    Lids(const Face& face, const std::string& shape, double side);

    // blink: 0 open, 1 shut.
    void pose(Nodes& mesh, double blink, const Gaze& gaze) const;

  private:
    std::vector<int> nodes_;
    Nodes moves_;                      // [nodes_ x 3], mm
    std::vector<double> rest_radius_;  // mm from the eye's centre
    EyeBall ball_;
};

}  // namespace viaface
