#include "synth/picture/changed_bands.hpp"

#include <algorithm>

namespace viaface {

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

Rect box_of(std::span<const int> nodes, std::span<const Eigen::Vector2f> pixels, const Rect& whole,
            float margin) {
    Eigen::Vector2f low = pixels[nodes.front()], high = low;
    for (const int node : nodes) {
        low = low.cwiseMin(pixels[node]);
        high = high.cwiseMax(pixels[node]);
    }
    const float more = margin * (high.y() - low.y());
    const Eigen::Vector2i from = (low.array() - more).cast<int>() - 1,
                          to = (high.array() + more).cast<int>() + 2;
    return common(whole, {from.x(), from.y(), to.x() - from.x(), to.y() - from.y()});
}

Extent within(const Extent& extent, const Rect& rect) {
    return {std::max<float>(extent.left, rect.left), std::min<float>(extent.right, rect.left + rect.width),
            std::max<float>(extent.bottom, rect.bottom),
            std::min<float>(extent.top, rect.bottom + rect.height)};
}

Extent both(const Extent& a, const Extent& b) {
    return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.bottom, b.bottom),
            std::max(a.top, b.top)};
}

ChangedBands::ChangedBands(int width, int height)
    : width_(width),
      height_(height),
      columns_((width + kTile - 1) / kTile),
      rows_((height + kTile - 1) / kTile),
      marked_(std::size_t(columns_) * rows_) {}

void ChangedBands::mark(const Extent& extent) {
    if (!touches(extent, {0, 0, width_, height_})) return;
    const int left = std::max(0, int(extent.left) / kTile);
    const int right = std::min(columns_ - 1, int(extent.right) / kTile);
    const int last = std::min(rows_ - 1, int(extent.top) / kTile);
    for (int row = std::max(0, int(extent.bottom) / kTile); row <= last; ++row) {
        const auto tiles = marked_.begin() + std::ptrdiff_t(row) * columns_;
        std::fill(tiles + left, tiles + right + 1, 1);
    }
}

std::vector<ChangedBands::Run> ChangedBands::runs_of(int row) const {
    std::vector<Run> runs;
    for (int column = 0; column < columns_; ++column) {
        if (!marked_[std::size_t(row) * columns_ + column]) continue;
        const bool near = !runs.empty() && column - runs.back().end <= kGap;
        if (!near) runs.push_back({column, column});
        runs.back().end = column + 1;
    }
    return runs;
}

std::vector<Rect> ChangedBands::take() {
    std::vector<Rect> bands;
    std::vector<std::size_t> below;  // bands that reach the row
    for (int row = 0; row < rows_; ++row) {
        std::vector<std::size_t> reaching;
        for (const auto [first, end] : runs_of(row)) {
            const int left = first * kTile, right = std::min(end * kTile, width_);
            const auto same = std::ranges::find_if(below, [&](std::size_t i) {
                return bands[i].left == left && bands[i].left + bands[i].width == right;
            });
            reaching.push_back(same == below.end() ? bands.size() : *same);
            if (same == below.end()) bands.push_back({left, row * kTile, right - left, 0});
            Rect& band = bands[reaching.back()];
            band.height = std::min((row + 1) * kTile, height_) - band.bottom;
        }
        below.swap(reaching);
    }
    std::ranges::fill(marked_, 0);
    return bands;
}

}  // namespace viaface
