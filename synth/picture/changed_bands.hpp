// Which rectangles of the picture must be drawn again: what does not move is not drawn twice. Triangles with
// a changed corner mark the tiles they covered and cover; neighbouring marked tiles form a band.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "synth/picture/rect.hpp"

namespace viaface {

struct Extent {
    float left, right, bottom, top;  // pixels
};

// All of what a triangle can touch, the reach of its edges' samples included.
inline Extent extent_of(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
    constexpr float kReach = 1.5f;  // pixels
    return {
        std::min(std::min(a.x(), b.x()), c.x()) - kReach, std::max(std::max(a.x(), b.x()), c.x()) + kReach,
        std::min(std::min(a.y(), b.y()), c.y()) - kReach, std::max(std::max(a.y(), b.y()), c.y()) + kReach};
}

Extent extent_of(const Rect& rect);

bool touches(const Extent& extent, const Rect& rect);
Rect common(const Rect& a, const Rect& b);  // empty: no width or no height
// Of nodes in the picture, `margin` of its height larger on each side, as far as it lies within `whole`.
Rect box_of(std::span<const int> nodes, std::span<const Eigen::Vector2f> pixels, const Rect& whole,
            float margin = 0);

Extent within(const Extent& extent, const Rect& rect);
Extent both(const Extent& a, const Extent& b);  // and what is between them

class ChangedBands {
  public:
    ChangedBands(int width, int height);

    void mark(const Extent& extent);
    // Rectangles that hold everything marked, apart from each other; then nothing is marked.
    std::vector<Rect> take();

  private:
    static constexpr int kTile = 16;  // pixels
    static constexpr int kGap = 1;    // tiles that are not worth leaving out
    struct Run {
        int first, end;  // columns of tiles
    };
    std::vector<Run> runs_of(int row) const;

    int width_, height_;
    int columns_, rows_;                // of tiles
    std::vector<std::uint8_t> marked_;  // [rows x columns]
};

}  // namespace viaface
