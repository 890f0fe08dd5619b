// A rectangle of pixels.
#pragma once

namespace viaface {

struct Rect {
    int left = 0, bottom = 0, width = 0, height = 0;  // pixels, from the lower left corner
    bool operator==(const Rect&) const = default;
};

}  // namespace viaface
