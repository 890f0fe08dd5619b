#include "synth/picture/changed_bands.hpp"

#include <algorithm>

namespace viaface {

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

ChangedBands::ChangedBands(int width, int height)
    : width_(width),
      height_(height),
      all_(Extent::of(Rect{0, 0, width, height})),
      columns_((width + kTile - 1) / kTile),
      rows_((height + kTile - 1) / kTile),
      marked_(std::size_t(columns_) * rows_) {}

void ChangedBands::mark(const Extent& extent) {
    if (!touch(extent, all_)) return;
    const Eigen::Array4i tiles = (within(extent, all_).bounds * (1.0f / kTile)).cast<int>();
    const int left = tiles[0], right = std::min(columns_ - 1, -tiles[2]);
    const int bottom = tiles[1], top = std::min(rows_ - 1, -tiles[3]);
    for (int row = bottom; row <= top; ++row) {
        for (int column = left; column <= right; ++column) marked_[std::size_t(row) * columns_ + column] = 1;
    }
}

void ChangedBands::take_from(ChangedBands& other) {
    for (std::size_t i = 0; i < marked_.size(); ++i) marked_[i] |= other.marked_[i];
    std::ranges::fill(other.marked_, 0);
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
