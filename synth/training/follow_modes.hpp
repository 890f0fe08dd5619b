// Lets lips, teeth, tongue and lining follow the modes of the skin, by least squares over the postures, so
// that a viewer of face.glb moves the whole face with one morph target. The talker's own pose does not use
// it: there lips follow their points and meet, and the jaw turns.
#pragma once

#include "synth/training/make_face.hpp"

namespace viaface {

// Fills the rows of face.modes that no mode drives. `training` is pose_training() of the same face and
// postures.
void follow_modes(Face& face, const HeadToFace& source, const PoseTraining& training,
                  const std::vector<Posture>& postures = talker_postures());

}  // namespace viaface
