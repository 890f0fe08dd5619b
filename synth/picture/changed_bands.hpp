// Which rectangles of the picture must be drawn again: what does not move is not drawn twice. Triangles with
// a changed corner mark the tiles they covered and cover; neighbouring marked tiles form a band.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "synth/picture/rect.hpp"

namespace viaface {

// Pixels from left to right and from bottom to top, with the signs turned so that the least of each holds
// all.
struct Extent {
    Eigen::Array4f bounds;  // left, bottom, -right, -top

    static Extent of(const Eigen::Vector2f& at) { return {{at.x(), at.y(), -at.x(), -at.y()}}; }
    static Extent of(const Rect& rect) {
        return {{float(rect.left), float(rect.bottom), -float(rect.left + rect.width),
                 -float(rect.bottom + rect.height)}};
    }
};

// And what is between them.
inline Extent both(const Extent& a, const Extent& b) { return {a.bounds.min(b.bounds)}; }
inline Extent within(const Extent& a, const Extent& b) { return {a.bounds.max(b.bounds)}; }
inline bool touch(const Extent& a, const Extent& b) {
    return (a.bounds + Eigen::Array4f(b.bounds[2], b.bounds[3], b.bounds[0], b.bounds[1]) < 0).all();
}

// All of what a triangle with these corners can touch, the reach of its edges' samples included.
inline Extent extent_of(const Extent& a, const Extent& b, const Extent& c) {
    constexpr float kReach = 1.5f;  // pixels
    return {both(both(a, b), c).bounds - kReach};
}

Rect common(const Rect& a, const Rect& b);  // empty: no width or no height
// Of nodes in the picture, `margin` of its height larger on each side, as far as it lies within `whole`.
Rect box_of(std::span<const int> nodes, std::span<const Eigen::Vector2f> pixels, const Rect& whole,
            float margin = 0);

class ChangedBands {
  public:
    ChangedBands(int width, int height);

    void mark(const Extent& extent);
    // What is marked in `other`, of the same size, which then has nothing marked.
    void take_from(ChangedBands& other);
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
    Extent all_;
    int columns_, rows_;                // of tiles
    std::vector<std::uint8_t> marked_;  // [rows x columns]
};

}  // namespace viaface
