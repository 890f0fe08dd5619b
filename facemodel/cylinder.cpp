#include "facemodel/cylinder.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace viaface {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

enum class Extreme { kHighest, kLowest };

// The highest or lowest of the samples within `reach` steps of (dx, dy); holes count for nothing.
std::vector<double> extremes(const std::vector<double>& map, int columns, int rows, int dx, int dy, int reach,
                             Extreme extreme) {
    std::vector<double> made(map.size(), kHole);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            double& best = made[static_cast<std::size_t>(y) * columns + x];
            for (int step = -reach; step <= reach; ++step) {
                const int sx = x + step * dx, sy = y + step * dy;
                if (sx < 0 || sy < 0 || sx >= columns || sy >= rows) continue;
                const double value = map[static_cast<std::size_t>(sy) * columns + sx];
                best = extreme == Extreme::kHighest ? std::fmax(best, value) : std::fmin(best, value);
            }
        }
    }
    return made;
}

}  // namespace

Vector3d Cylinder::unrolled(const Vector3d& head) const {
    const double forward = head.z() - axis_z;
    return {radius * std::atan2(head.x(), forward), head.y(), std::hypot(head.x(), forward)};
}

Vector3d Cylinder::rolled(const Vector3d& flat) const {
    const double theta = flat.x() / radius;
    return {flat.z() * std::sin(theta), flat.y(), axis_z + flat.z() * std::cos(theta)};
}

Vector2d RangeFrame::place(int column, int row) const {
    return {u_min + (u_max - u_min) * (column + 0.5) / columns,
            height_min + (height_max - height_min) * (row + 0.5) / rows};
}

Vector2d RangeFrame::cell(const Vector2d& place) const {
    return {(place.x() - u_min) / (u_max - u_min) * columns - 0.5,
            (place.y() - height_min) / (height_max - height_min) * rows - 0.5};
}

RangeMap::RangeMap(const RangeFrame& frame, const Nodes& nodes, const std::vector<Triangle>& triangles)
    : frame_(frame), range_(static_cast<std::size_t>(frame.columns) * frame.rows, kHole) {
    for (const Triangle& triangle : triangles) draw(nodes, triangle);
    close_pits();
}

void RangeMap::close_pits() {
    constexpr double kHalfWidth = 2.5, kDepth = 2;  // mm
    const int across = static_cast<int>(kHalfWidth * frame_.columns / (frame_.u_max - frame_.u_min));
    const int along = static_cast<int>(kHalfWidth * frame_.rows / (frame_.height_max - frame_.height_min));
    std::vector<double> closed = range_;
    for (const Extreme extreme : {Extreme::kHighest, Extreme::kLowest}) {
        closed = extremes(closed, frame_.columns, frame_.rows, 1, 0, across, extreme);
        closed = extremes(closed, frame_.columns, frame_.rows, 0, 1, along, extreme);
    }
    for (std::size_t i = 0; i < range_.size(); ++i) {
        if (closed[i] - range_[i] > kDepth) range_[i] = closed[i];
    }
}

// Solves axis + r * direction = a + s (b - a) + t (c - a) for every sample in the triangle's box.
void RangeMap::draw(const Nodes& nodes, const Triangle& triangle) {
    const Vector3d a = nodes.row(triangle[0]), b = nodes.row(triangle[1]), c = nodes.row(triangle[2]);
    Vector2d low = Vector2d::Constant(1e9), high = -low;
    for (const Vector3d& corner : {a, b, c}) {
        const Vector2d cell = frame_.cell(frame_.cylinder.unrolled(corner).head<2>());
        low = low.cwiseMin(cell);
        high = high.cwiseMax(cell);
    }
    if (high.x() - low.x() > frame_.columns / 2) return;  // it crosses the seam behind the head
    constexpr double kEdge = 1e-9;
    const int first_column = std::max(0, static_cast<int>(std::floor(low.x()))),
              last_column = std::min(frame_.columns - 1, static_cast<int>(std::ceil(high.x())));
    const int first_row = std::max(0, static_cast<int>(std::floor(low.y()))),
              last_row = std::min(frame_.rows - 1, static_cast<int>(std::ceil(high.y())));
    for (int row = first_row; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column) {
            const Vector2d place = frame_.place(column, row);
            const Vector3d axis(0, place.y(), frame_.cylinder.axis_z);
            const Vector3d direction = frame_.cylinder.rolled({place.x(), place.y(), 1}) - axis;
            Eigen::Matrix3d system;
            system << direction, a - b, a - c;
            const Vector3d solved = system.inverse() * (a - axis);
            const bool inside =
                solved.y() >= -kEdge && solved.z() >= -kEdge && solved.y() + solved.z() <= 1 + kEdge;
            if (!solved.allFinite() || !inside || solved.x() <= 0) continue;
            double& range = range_[static_cast<std::size_t>(row) * frame_.columns + column];
            if (!(range >= solved.x())) range = solved.x();
        }
    }
}

std::optional<double> RangeMap::sample(int column, int row) const {
    if (column < 0 || row < 0 || column >= frame_.columns || row >= frame_.rows) return {};
    const double range = range_[static_cast<std::size_t>(row) * frame_.columns + column];
    return std::isnan(range) ? std::nullopt : std::optional(range);
}

std::optional<double> RangeMap::range(const Vector2d& place, int reach) const {
    const Vector2d cell = frame_.cell(place);
    const int column = static_cast<int>(std::floor(cell.x())), row = static_cast<int>(std::floor(cell.y()));
    const Vector2d part = cell - Vector2d(column, row);
    double sum = 0, weights = 0;
    for (const int right : {0, 1}) {
        for (const int up : {0, 1}) {
            const auto r = sample(column + right, row + up);
            const double weight = (right ? part.x() : 1 - part.x()) * (up ? part.y() : 1 - part.y());
            if (r) sum += weight * *r, weights += weight;
        }
    }
    constexpr double kEnough = 0.25;  // of the weight: a quarter of the cell is surface
    return weights >= kEnough ? std::optional(sum / weights) : nearest(cell, reach);
}

std::optional<double> RangeMap::nearest(const Vector2d& cell, int reach) const {
    const int column = static_cast<int>(std::lround(cell.x())), row = static_cast<int>(std::lround(cell.y()));
    std::optional<double> found;
    double closest = std::numeric_limits<double>::infinity();
    for (int y = row - reach; y <= row + reach; ++y) {
        for (int x = column - reach; x <= column + reach; ++x) {
            const double distance = (Vector2d(x, y) - cell).squaredNorm();
            const auto r = sample(x, y);
            if (r && distance < closest) closest = distance, found = r;
        }
    }
    return found;
}

int RangeMap::samples() const {
    return static_cast<int>(std::ranges::count_if(range_, [](double r) { return !std::isnan(r); }));
}

}  // namespace viaface
