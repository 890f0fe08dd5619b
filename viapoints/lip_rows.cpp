#include "viapoints/lip_rows.hpp"

#include <algorithm>

namespace viaface {

std::optional<LipRows> lip_rows(const ConfigurationBasis& basis) {
    const auto height = [&](Point point) { return basis.modes.row(3 * point + 1); };
    const std::pair<Point, Point> pairs[] = {
        {kInnerTop, kInnerBottom}, {kLipTop, kLipBottom}, {kBorderTop, kBorderBottom}};
    const auto moves = [&](const auto& pair) {
        return !height(pair.first).isZero(0) && !height(pair.second).isZero(0);
    };
    const auto pair = std::find_if(std::begin(pairs), std::end(pairs), moves);
    if (pair == std::end(pairs)) return std::nullopt;
    return LipRows{height(pair->second), height(pair->first) - height(pair->second)};
}

}  // namespace viaface
