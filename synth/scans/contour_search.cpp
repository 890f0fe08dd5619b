#include "synth/scans/contour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Vector2d, Eigen::Vector3f;

constexpr int kNumbers = 5;
using Numbers = ContourNumbers;

struct Middle {
    Vector2d place;
    Vector2d half;  // width, height
};

Middle middle_of(const PlaneLoop& loop) {
    Vector2d low = loop[0], high = loop[0];
    for (const Vector2d& p : loop) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return {(low + high) / 2, (high - low) / 2};
}

PlaneLoop shaped(const PlaneLoop& loop, const Middle& middle, const Numbers& n, double about = 1) {
    PlaneLoop result;
    for (const Vector2d& p : loop) {
        const Vector2d from = about * (p - middle.place);
        result.push_back(middle.place +
                         Vector2d(n[0] + n[2] * from.x(), n[1] + (from.y() > 0 ? n[3] : n[4]) * from.y()));
    }
    return result;
}

// Redness, and brightness in hundreds.
Vector2d feature_of(const Vector3f& colour) {
    const float sum = colour.sum() + 1;
    return {10 * (colour[0] - colour[1]) / sum, std::log(sum / 3 + 10)};
}

struct Sums {
    Vector2d sum = Vector2d::Zero(), squares = Vector2d::Zero();
    double count = 0;

    void add(const Vector2d& value) {
        sum += value;
        squares += value.cwiseProduct(value);
        count += 1;
    }
    Vector2d mean() const { return sum / std::max(count, 1.0); }
    Vector2d variance() const {
        return (squares / std::max(count, 1.0) - mean().cwiseProduct(mean())).cwiseMax(0.0);
    }
};

double contrast(const SurfaceView& view, const PlaneLoop& loop, const Middle& middle, const Numbers& n,
                Within what) {
    Sums within, around;
    for (const auto& [scale, inside] :
         {std::pair{0.6, true}, {0.75, true}, {0.9, true}, {1.12, false}, {1.28, false}, {1.45, false}}) {
        for (const Vector2d& p : shaped(loop, middle, n, scale)) {
            const Vector2d pixel = view.window.pixel(p.x(), p.y());
            const int column = static_cast<int>(std::lround(pixel.x())),
                      row = static_cast<int>(std::lround(pixel.y()));
            if (column < 0 || row < 0 || column >= view.window.width || row >= view.window.height) continue;
            const std::size_t at = view.at(column, row);
            if (std::isnan(view.depth[at])) continue;
            (inside ? within : around).add(feature_of(view.colours[at]));
        }
    }
    if (within.count < 20 || around.count < 20) return 0;
    const Vector2d difference = within.mean() - around.mean();
    const Vector2d spread = within.variance() + around.variance() + Vector2d(0.02, 0.005);
    // Eyes are less red than lids, lips redder than the skin about them; both are darker.
    const double red = std::max(0.0, what == Within::kLips ? difference.x() : -difference.x());
    const double dark = std::max(0.0, -difference.y());
    return red * red / spread.x() + 0.5 * dark * dark / spread.y();
}

double unlikely(const Numbers& n, double size) {
    const double shift = (n[0] * n[0] + n[1] * n[1]) / (size * size);
    double stretch = 0;
    for (int k = 2; k < kNumbers; ++k) stretch += std::log(n[k]) * std::log(n[k]);
    return 1.2 * shift + 0.8 * stretch;
}

}  // namespace

ShapedContour shaped_contour(const SurfaceView& view, const PlaneLoop& generic, Within what, double freedom) {
    const Middle middle = middle_of(generic);
    const double size = middle.half.x();
    const auto worth = [&](const Numbers& n) {
        return std::log(0.05 + contrast(view, generic, middle, n, what)) -
               unlikely(n, size) / (freedom * freedom);
    };
    Numbers best = {0, 0, 1, 1, 1};
    double highest = worth(best);
    for (double step : {0.24, 0.12, 0.06, 0.03, 0.015}) {
        for (int round = 0; round < 6; ++round) {
            bool better = false;
            for (int k = 0; k < kNumbers; ++k) {
                for (const double sign : {-1.0, 1.0}) {
                    Numbers tried = best;
                    tried[k] = k < 2 ? best[k] + sign * step * size : best[k] * std::exp(sign * step);
                    if (k >= 2 && std::abs(std::log(tried[k])) > 0.6) continue;
                    const double value = worth(tried);
                    if (value <= highest) continue;
                    best = tried;
                    highest = value;
                    better = true;
                }
            }
            if (!better) break;
        }
    }
    ShapedContour found{best, shaped(generic, middle, best), contrast(view, generic, middle, best, what), 0};
    for (std::size_t i = 0; i < generic.size(); ++i)
        found.moved += (found.loop[i] - generic[i]).norm() / static_cast<double>(generic.size());
    return found;
}

PlaneLoop shaped_by(const PlaneLoop& generic, const ContourNumbers& numbers) {
    return shaped(generic, middle_of(generic), numbers);
}

PlaneLoop between_corners(const PlaneLoop& loop, const Vector2d& left, const Vector2d& right) {
    const auto [low, high] = std::ranges::minmax(loop, {}, [](const Vector2d& p) { return p.x(); });
    const double stretch = (right.x() - left.x()) / (high.x() - low.x());
    PlaneLoop moved;
    for (const Vector2d& p : loop) {
        const double share = (p.x() - low.x()) / (high.x() - low.x());
        const double level = low.y() + share * (high.y() - low.y());
        moved.emplace_back(left.x() + stretch * (p.x() - low.x()),
                           left.y() + share * (right.y() - left.y()) + (p.y() - level));
    }
    return moved;
}

namespace {

constexpr double kStep = 0.25, kAcross = 1.5;  // mm

// How much a place looks like the line between lips: darker than above and below it, and concave.
double groove_at(const SurfaceView& view, const Vector2d& p) {
    const auto brightness = [&](double dy) {
        const Vector2d pixel = view.window.pixel(p.x(), p.y() + dy);
        const int column = std::clamp(static_cast<int>(pixel.x()), 0, view.window.width - 1),
                  row = std::clamp(static_cast<int>(pixel.y()), 0, view.window.height - 1);
        return view.colours[view.at(column, row)].sum() / 765.0;
    };
    const double here = view.depth_at(p.x(), p.y()), above = view.depth_at(p.x(), p.y() + kAcross),
                 below = view.depth_at(p.x(), p.y() - kAcross);
    const double hollow = std::isnan(above + below + here) ? 0 : (above + below) / 2 - here;  // mm
    const double dark = std::min(brightness(2.5), brightness(-2.5)) - brightness(0);
    return hollow + 4 * dark;
}

}  // namespace

PlaneLoop lip_line(const SurfaceView& view, const Vector2d& left, const Vector2d& right) {
    constexpr double kBeyond = 15, kReach = 8;  // mm
    const int columns = static_cast<int>((right.x() - left.x() + 2 * kBeyond) / kStep) + 1,
              rows = static_cast<int>(2 * kReach / kStep) + 1;
    const Vector2d along = (right - left).normalized();
    const auto place = [&](int c, int r) -> Vector2d {
        return left + (c * kStep - kBeyond) * along + Vector2d(0, (r - rows / 2) * kStep);
    };
    const auto at = [&](int c, int r) { return static_cast<std::size_t>(c) * rows + r; };
    std::vector<double> groove(static_cast<std::size_t>(columns) * rows), total;
    for (int c = 0; c < columns; ++c) {
        for (int r = 0; r < rows; ++r) groove[at(c, r)] = groove_at(view, place(c, r));
    }
    total.assign(groove.size(), 0);
    std::vector<int> from(groove.size());
    for (int c = 0; c < columns; ++c) {
        for (int r = 0; r < rows; ++r) {
            const double off = (r - rows / 2) * kStep / kReach;
            double least = c == 0 ? 0 : 1e300;
            for (int before = std::max(0, r - 2); c > 0 && before <= std::min(rows - 1, r + 2); ++before) {
                const double sum = total[at(c - 1, before)] + 0.1 * (before - r) * (before - r);
                if (sum >= least) continue;
                least = sum;
                from[at(c, r)] = before;
            }
            total[at(c, r)] = least - groove[at(c, r)] + 0.3 * off * off;
        }
    }
    std::vector<int> path(static_cast<std::size_t>(columns));
    const auto last = total.end() - rows;
    int r = static_cast<int>(std::min_element(last, total.end()) - last);
    for (int c = columns - 1; c >= 0; --c) {
        path[c] = r;
        r = from[at(c, r)];
    }
    // Strength over 3 mm; the corners are where it falls below a share of the middle's.
    const auto strength = [&](int c) {
        double sum = 0;
        for (int k = std::max(0, c - 6); k <= std::min(columns - 1, c + 6); ++k)
            sum += groove[at(k, path[k])] / 13;
        return sum;
    };
    std::vector<double> middle;
    for (int c = columns / 2 - 40; c <= columns / 2 + 40; c += 4) middle.push_back(strength(c));
    std::ranges::sort(middle);
    const double least = 0.3 * middle[middle.size() / 2];
    int first = columns / 2, end = columns / 2;
    while (first > 0 && strength(first - 1) > least) --first;
    while (end + 1 < columns && strength(end + 1) > least) ++end;
    PlaneLoop line;
    for (int c = first; c <= end; c += 4) line.push_back(place(c, path[c]));
    return line;
}

}  // namespace viaface
