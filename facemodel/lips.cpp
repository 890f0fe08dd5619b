#include "facemodel/lips.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Vector3d;
constexpr int kRows = LipGrid::kRows, kColumns = LipGrid::kColumns, kMiddle = LipGrid::kMiddleRow;

constexpr double kAdhesion = 0.5;  // mm: lips this near begin to cling to each other

// The opening that is drawn for one that is asked for: none past contact, all of it from kAdhesion on, smooth
// between.
double drawn_gap(double asked) {
    if (asked <= 0) return 0;
    if (asked >= kAdhesion) return asked;
    return asked * asked * (2 * kAdhesion - asked) / (kAdhesion * kAdhesion);
}

int at(int row, int column) { return row * kColumns + (column + kColumns) % kColumns; }

double smooth(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// 0 at the border, 1 from `full` on inwards.
double hold(int row, int full) { return smooth(static_cast<double>(row) / full); }

// The lips' meeting height over x: midway between the inner contours, level beyond the corners.
struct MeetingLine {
    std::array<double, kColumns / 2 + 1> x{}, y{};  // from the right corner to the left

    explicit MeetingLine(const Nodes& rows) {
        for (int k = 0; k <= kColumns / 2; ++k) {
            const int column = (kRightCorner + k) % kColumns;
            const Vector3d middle =
                (rows.row(at(kRows - 1, column)) + rows.row(at(kRows - 1, facing_column(column))))
                    .transpose() /
                2;
            x[static_cast<std::size_t>(k)] = middle.x();
            y[static_cast<std::size_t>(k)] = middle.y();
        }
    }

    double middle_of(int column) const {
        const int k = (column - kRightCorner + kColumns) % kColumns;
        return x[static_cast<std::size_t>(std::min(k, kColumns - k))];
    }

    bool spans(double place) const { return place > x.front() && place < x.back(); }

    double operator()(double place) const {
        const auto after = std::upper_bound(x.begin() + 1, x.end() - 1, place);
        const auto k = static_cast<std::size_t>(after - x.begin());
        const double t = std::clamp((place - x[k - 1]) / std::max(x[k] - x[k - 1], 1e-6), 0.0, 1.0);
        return y[k - 1] + t * (y[k] - y[k - 1]);
    }
};

}  // namespace

Nodes lip_rows(const LipContours& contours) {
    Nodes rows(kRows * kColumns, 3);
    for (int c = 0; c < kColumns; ++c) {
        const Vector3d p0 = contours.outer.row(c), p1 = contours.middle.row(c), p2 = contours.inner.row(c);
        const double h0 = std::max((p1 - p0).norm(), 1e-6), h1 = std::max((p2 - p1).norm(), 1e-6);
        const Vector3d bend = 3 * ((p2 - p1) / h1 - (p1 - p0) / h0) / (h0 + h1);  // second derivative at p1
        const auto piece = [&](const Vector3d& a, const Vector3d& b, double h, double t,
                               bool rising) -> Vector3d {
            const double s = rising ? t : 1 - t;
            return (1 - t) * a + t * b + h * h / 6 * (s * s * s - s) * bend;
        };
        for (int r = 0; r < kRows; ++r) {
            const double t = static_cast<double>(r) / kMiddle;
            rows.row(at(r, c)) =
                (r <= kMiddle ? piece(p0, p1, h0, t, true) : piece(p1, p2, h1, t - 1, false)).transpose();
        }
    }
    return rows;
}

std::vector<Triangle> lip_triangles(const LipGrid& grid) {
    std::vector<Triangle> triangles;
    for (int r = 0; r + 1 < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) {
            const int a = grid.node(r, c), b = grid.node(r + 1, c), d = grid.node(r + 1, c + 1),
                      e = grid.node(r, c + 1);
            triangles.push_back({a, b, d});
            triangles.push_back({a, d, e});
        }
    }
    return triangles;
}

void keep_off_teeth(Nodes& rows, const TeethFront& teeth) {
    constexpr int kFirstRow = 4;
    constexpr double kFrontHalf = 9, kFade = 6;  // mm from the middle: in full, then less and less
    constexpr double kHighest = 6;               // mm past the edge; what is farther was never beyond it
    constexpr double kEdgeFirst = 3;  // the other lip comes from beyond the edge and stops there rather
    constexpr double kRound = 1.5;    // mm: within this of the edge its own lip is let over it
    for (int c = 0; c < kColumns; ++c) {
        const bool other = upper_lip(c) != (teeth.side > 0);
        for (int r = kFirstRow; r < kRows; ++r) {
            auto node = rows.row(at(r, c));
            const double into = teeth.z(node.x()) - node.z();            // behind the front, mm
            const double over = teeth.side * (node.y() - teeth.edge_y);  // past the edge, mm
            if (into <= 0 || over <= 0) continue;
            const double front = 1 - smooth((std::abs(node.x()) - kFrontHalf) / kFade);
            // Both ways out are blended, so that no lip jumps from the one to the other.
            const double back = other ? (1 - smooth(over / (kEdgeFirst * into) - 0.5)) *
                                            (1 - smooth((over - kHighest) / 2 + 1))
                                      : 0;
            const double forth = other ? 1 - back : smooth(over / kRound);
            node.y() -= teeth.side * front * back * over;
            node.z() += front * forth * into;
        }
    }
}

void keep_lips_apart(Nodes& rows) {
    const MeetingLine line(rows);
    std::array<double, kColumns> gaps{};
    for (int c = 0; c < kColumns; ++c)
        gaps[static_cast<std::size_t>(c)] = (upper_lip(c) ? 1 : -1) * lip_gap(rows, c);
    for (int c = 0; c < kColumns; ++c) {
        if (c == kLeftCorner || c == kRightCorner) continue;
        const double side = upper_lip(c) ? 1 : -1, gap = gaps[static_cast<std::size_t>(c)];
        const double at_edge =
            (drawn_gap(gap) - gap) / 2;  // how far the inner node goes away from the other lip
        double deepest = 0;
        int full = kRows - 1;
        for (int r = kMiddle; r + 1 < kRows; ++r) {
            const auto node = rows.row(at(r, c));
            const double depth = line.spans(node.x()) ? side * (line(node.x()) - node.y()) : 0;
            if (depth > std::max(deepest, at_edge)) {
                deepest = depth;
                full = r;
            }
        }
        // Pressed lips do not slide: what meets, meets at one place across.
        const double pressed = 1 - std::clamp(gap / kAdhesion, 0.0, 1.0);
        const double aside = pressed * (line.middle_of(c) - rows(at(kRows - 1, c), 0));
        for (int r = 1; r < kRows; ++r) {
            auto node = rows.row(at(r, c));
            const double beyond =
                full + 1 < kRows ? std::clamp((r - full) / (kRows - 1.0 - full), 0.0, 1.0) : 1;
            node.x() += aside * hold(r, kRows - 1);
            node.y() += side * hold(r, full) * ((1 - beyond) * deepest + beyond * at_edge);
            if (r < kMiddle || r + 1 == kRows || !line.spans(node.x())) continue;
            if (side * (line(node.x()) - node.y()) > 0) node.y() = line(node.x());
        }
    }
}

double lip_gap(const Nodes& rows, int column) {
    return rows(at(kRows - 1, column), 1) - rows(at(kRows - 1, facing_column(column)), 1);
}

}  // namespace viaface
