#include "facemodel/face.hpp"

#include <algorithm>
#include <stdexcept>

namespace viaface {

const FacePart& part_named(const Face& face, std::string_view name) {
    const auto found = std::ranges::find(face.parts, name, &FacePart::name);
    if (found == face.parts.end()) throw std::invalid_argument("the face has no part " + std::string(name));
    return *found;
}

}  // namespace viaface
