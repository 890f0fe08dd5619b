// The colours that a shape's own regions show: what the classes are learned from once the lips are found, so
// that nobody has to pick samples by hand.
#pragma once

#include "lipmodel/colour_classes.hpp"
#include "lipmodel/lip_camera.hpp"

namespace viaface {

struct RegionSamples {
    std::vector<Rgb> lips, skin, opening;
};

// Four pixels of every face that is seen and at least `least_area` px^2 large (an opening that is shut shows
// lips); what lies outside the picture is left out.
RegionSamples sample_regions(const Pinhole& camera, const LipPose& pose, const Nodes& lips,
                             const Picture& picture, double least_area = 0.5);

}  // namespace viaface
