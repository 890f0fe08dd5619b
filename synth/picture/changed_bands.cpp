#include "synth/picture/changed_bands.hpp"

#include <algorithm>

namespace viaface {
namespace {

constexpr float kReach = 1.5f;  // pixels

}  // namespace

Extent extent_of(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
    return {std::min({a.x(), b.x(), c.x()}) - kReach, std::max({a.x(), b.x(), c.x()}) + kReach,
            std::min({a.y(), b.y(), c.y()}) - kReach, std::max({a.y(), b.y(), c.y()}) + kReach};
}

Extent extent_of(const Rect& rect) {
    return {float(rect.left), float(rect.left + rect.width), float(rect.bottom),
            float(rect.bottom + rect.height)};
}

bool touches(const Extent& extent, const Rect& rect) {
    return extent.left < rect.left + rect.width && extent.right > rect.left &&
           extent.bottom < rect.bottom + rect.height && extent.top > rect.bottom;
}

Rect common(const Rect& a, const Rect& b) {
    const int left = std::max(a.left, b.left), bottom = std::max(a.bottom, b.bottom);
    return {left, bottom, std::max(0, std::min(a.left + a.width, b.left + b.width) - left),
            std::max(0, std::min(a.bottom + a.height, b.bottom + b.height) - bottom)};
}

Extent within(const Extent& extent, const Rect& rect) {
    return {std::max<float>(extent.left, rect.left), std::min<float>(extent.right, rect.left + rect.width),
            std::max<float>(extent.bottom, rect.bottom),
            std::min<float>(extent.top, rect.bottom + rect.height)};
}

ChangedBands::ChangedBands(int width, int height) : width_(width), height_(height) {
    rows_.assign((height + kTile - 1) / kTile, empty());
}

void ChangedBands::mark(const Extent& extent) {
    if (!touches(extent, {0, 0, width_, height_})) return;
    const int left = std::max(0, int(extent.left));
    const int right = std::min(width_, int(extent.right) + 1);
    const int first = std::max(0, int(extent.bottom) / kTile);
    const int last = std::min(int(rows_.size()) - 1, int(extent.top) / kTile);
    for (int row = first; row <= last; ++row) {
        rows_[row] = {std::min(rows_[row].left, left), std::max(rows_[row].right, right)};
    }
}

std::vector<Rect> ChangedBands::take() {
    std::vector<Rect> bands;
    bool open = false;
    for (int row = 0; row < int(rows_.size()); ++row) {
        const auto [left, right] = rows_[row];
        if (left < right) {
            if (!open) bands.push_back({left, row * kTile, 0, 0});
            Rect& band = bands.back();
            const int band_right = std::max(band.left + band.width, right);
            band.left = std::min(band.left, left);
            band.width = band_right - band.left;
            band.height = std::min((row + 1) * kTile, height_) - band.bottom;
        }
        open = left < right;
        rows_[row] = empty();
    }
    return bands;
}

}  // namespace viaface
