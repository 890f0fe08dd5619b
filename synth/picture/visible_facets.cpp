#include "synth/picture/visible_facets.hpp"

namespace viaface {

void find_visible(const Sight& sight, int first, int end, std::vector<VisibleFacet>& visible) {
    visible.clear();
    for (int i = first; i < end; ++i) {
        if (sight.seen[i] == 0) continue;
        raster::Bounds box = raster::common(sight.boxes[i], sight.drawn);
        if (sight.facets[i].inside) box = raster::common(box, sight.opening);
        if (box.left < box.right && box.bottom < box.top)
            visible.push_back({box, std::uint32_t(i), sight.facets[i].fine});
    }
}

}  // namespace viaface
