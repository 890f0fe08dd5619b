// First classes of lips, skin and opening, before any model has been fitted. Place is what tells at first: an
// ellipse about the mouth holds lips, but for what is dark in its middle, or paler than the skin as teeth
// are, and skin lies well outside. Then classes are learned and every colour goes, lips or skin, to the class
// that it fits better, weighed by what is expected at its place: classification expectation maximisation
// [CeleuxGovaert92]. So lips need not be the reddest of the face: pale ones, dark skin's.
#pragma once

#include <functional>

#include "lipmodel/mouth_finder.hpp"

namespace viaface {

// How far from the mouth's middle, and how high, in halves of the mouth's width and height.
struct PlacedColour {
    Rgb colour;
    double far, height;
};

std::vector<PlacedColour> colours_about(const Picture& picture, const FaceInPicture& face,
                                        const MouthInPicture& mouth);

struct MouthSamples {
    std::vector<Rgb> lips, skin, opening;
};
using LearnClasses = std::function<ColourClasses(const MouthSamples&)>;

ColourClasses first_classes(std::span<const PlacedColour> colours, const LearnClasses& learn);

}  // namespace viaface
