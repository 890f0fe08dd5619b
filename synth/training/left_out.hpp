// How far the drawn face is from the one asked for, on postures that its modes and estimators were not made
// from: each of the talker's postures left out in turn, and shapes of the head that no posture is.
#pragma once

#include <string>
#include <vector>

#include "synth/training/make_face.hpp"

namespace viaface {

struct DrawnDistance {
    std::string name;
    double mean_mm = 0, ninety_fifth_mm = 0, largest_mm = 0;  // over the nodes of the skin and the lips
};

// The order of `postures`; each is drawn from its points by a face made of the others.
std::vector<DrawnDistance> left_out_distances(const HeadToFace& source,
                                              const std::vector<Posture>& postures = talker_postures());

// Each drawn by the face of all postures.
std::vector<DrawnDistance> unseen_distances(const HeadToFace& source, const std::vector<Posture>& unseen,
                                            const std::vector<Posture>& postures = talker_postures());

}  // namespace viaface
