// Where eyes and mouth are in the first picture of a film, by hand, where the detectors fail. JSON:
//   {"eyes": [[u, v], [u, v]], "mouth": [u, v, width, height]}
// px of the film, origin at the centre of the top left pixel; "mouth" (its centre and size) may be left out.
// The eye on the left of the picture comes first.
#pragma once

#include <string_view>

#include "lipmodel/mouth_finder.hpp"

namespace viaface {

struct Hint {
    FaceInPicture face;
    std::optional<MouthInPicture> mouth = {};
};

// InputError("--hint", ...) for anything else.
Hint parse_hint(std::string_view json);

}  // namespace viaface
