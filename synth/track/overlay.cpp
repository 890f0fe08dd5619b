#include "synth/track/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace viaface {
namespace {

constexpr Rgb kBorder{40, 230, 60}, kInner{255, 235, 40}, kLost{230, 30, 30};

void dot(Frame& frame, double x, double y, const Rgb& colour) {
    const long column = std::lround(x), row = std::lround(y);
    if (column < 0 || row < 0 || column >= frame.width || row >= frame.height) return;
    std::uint8_t* pixel = frame.rgba.data() + 4 * (static_cast<std::size_t>(row) * frame.width + column);
    std::copy(colour.begin(), colour.end(), pixel);
}

void stroke(Frame& frame, const Eigen::RowVector2d& from, const Eigen::RowVector2d& to, const Rgb& colour) {
    const Eigen::RowVector2d way = to - from;
    const double longest = std::min(way.cwiseAbs().maxCoeff(), 2.0 * (frame.width + frame.height));
    const int steps = std::max(1, static_cast<int>(std::ceil(longest)));
    for (int i = 0; i <= steps; ++i) {
        const Eigen::RowVector2d place = from + way * (static_cast<double>(i) / steps);
        dot(frame, place.x(), place.y(), colour);
    }
}

void ring(Frame& frame, const Pixels& pixels, int ring, const Rgb& colour) {
    for (int column = 0; column < LipMesh::kColumns; ++column) {
        stroke(frame, pixels.row(LipMesh::node(ring, column)), pixels.row(LipMesh::node(ring, column + 1)),
               colour);
    }
}

}  // namespace

void draw_lips(Frame& frame, const TrackedLips& lips) {
    if (lips.found) {
        ring(frame, lips.pixels, LipMesh::kBorderRing, kBorder);
        ring(frame, lips.pixels, LipMesh::kInnerRing, kInner);
        return;
    }
    const double right = frame.width - 1, bottom = frame.height - 1;
    const std::array<Eigen::RowVector2d, 4> corners = {{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
        stroke(frame, corners[i], corners[(i + 1) % corners.size()], kLost);
}

}  // namespace viaface
