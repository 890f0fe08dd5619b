#include "facemodel/features.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace viaface {
namespace {

using Eigen::Vector2d;

struct Place {
    int left, right;  // feature points; the same on the midline
    double u, height;
};
constexpr int M = kFirstMarker;
constexpr Place kGeneric[] = {
    // jaw line, from the chin to the ear
    {8, 8, 0, -41},
    {9, 7, 16, -38},
    {10, 6, 37, -34},
    {11, 5, 60, -26},
    {12, 4, 82, -9},
    {13, 3, 95, 11},
    {14, 2, 103, 30},
    {15, 1, 109, 50},
    {16, 0, 112, 72},
    // brows
    {22, 21, 12, 94},
    {23, 20, 24, 97},
    {24, 19, 39, 97},
    {25, 18, 53, 94},
    {26, 17, 66, 87},
    // nose: bridge and base
    {27, 27, 0, 72},
    {28, 28, 0, 61},
    {29, 29, 0, 50},
    {30, 30, 0, 40},
    {33, 33, 0, 22.5},
    {34, 32, 6, 23.5},
    {35, 31, 12, 24},
    // eyes
    {42, 39, 22, 67.5},
    {43, 38, 31, 74.5},
    {44, 37, 42, 74},
    {45, 36, 52, 69},
    {46, 41, 42, 65.5},
    {47, 40, 31, 65.5},
    // lips, red and inner: only the markers' contour is used
    {51, 51, 0, 10},
    {52, 50, 6, 10.5},
    {53, 49, 16, 7},
    {54, 48, 26, 0},
    {55, 59, 17, -5.5},
    {56, 58, 9, -8},
    {57, 57, 0, -9},
    {62, 62, 0, 2},
    {63, 61, 9, 2},
    {64, 60, 23, 0},
    {65, 67, 10, 1},
    {66, 66, 0, 1},
    // markers
    {M + 0, M + 0, 0, 12},
    {M + 1, M + 7, 16, 9},
    {M + 2, M + 6, 28, -1},
    {M + 3, M + 5, 17.5, -8},
    {M + 4, M + 4, 0, -11},
    {M + 8, M + 8, 0, -27},
    {M + 9, M + 10, 15.5, -28.5},
    {M + 11, M + 12, 60, -26},
    {M + 13, M + 14, 45, 1.5},
    {M + 15, M + 16, 44, 42},
    {M + 17, M + 17, 0, 36}};

std::vector<int> counted(int first, int last) {
    std::vector<int> all(static_cast<std::size_t>(last - first + 1));
    std::iota(all.begin(), all.end(), first);
    return all;
}

FeatureContour outline() {
    FeatureContour contour{"outline", counted(0, 16), std::vector<int>(16, 2), true};
    for (int i = 0; i < kForehead; ++i) contour.through.push_back(kFirstForehead + i);
    contour.steps.insert(contour.steps.end(), {3, 3, 4, 4, 3, 3});
    return contour;
}

Vector2d catmull_rom(const std::array<Vector2d, 4>& p, double t) {
    return 0.5 * (2 * p[1] + t * (p[2] - p[0]) + t * t * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) +
                  t * t * t * (3 * p[1] - p[0] - 3 * p[2] + p[3]));
}

// Before the first and after the last point of an open contour: the point itself, reflected.
Vector2d control(const FeatureContour& contour, const FeaturePoints& points, int i) {
    const int n = static_cast<int>(contour.through.size());
    const auto at = [&](int k) -> Vector2d { return points.row(contour.through[k]); };
    if (contour.closed) return at((i + n) % n);
    if (i < 0) return 2 * at(0) - at(1);
    if (i >= n) return 2 * at(n - 1) - at(n - 2);
    return at(i);
}

}  // namespace

void place_forehead(FeaturePoints& points) {
    constexpr double kRise = 0.6;  // of the half width
    const Vector2d right = points.row(0), left = points.row(16);
    const Vector2d centre = (right + left) / 2, across = (left - right) / 2;
    const Vector2d up = kRise * Vector2d(-across.y(), across.x());
    for (int i = 0; i < kForehead; ++i) {
        const double angle = std::numbers::pi * (i + 1) / (kForehead + 1);
        points.row(kFirstForehead + i) = centre + std::cos(angle) * across + std::sin(angle) * up;
    }
}

FeaturePoints unrolled_features(const Cylinder& cylinder, const Nodes& landmarks, const Nodes& markers) {
    FeaturePoints points;
    for (int i = 0; i < kLandmarks; ++i) {
        points.row(i) = cylinder.unrolled(landmarks.row(i).transpose()).head<2>();
    }
    for (int i = 0; i < kMarkers; ++i) {
        points.row(kFirstMarker + i) = cylinder.unrolled(markers.row(i).transpose()).head<2>();
    }
    place_forehead(points);
    return points;
}

FeaturePoints generic_features() {
    FeaturePoints points;
    for (const auto& [left, right, u, height] : kGeneric) {
        points.row(right) << -u, height;
        points.row(left) << u, height;
    }
    place_forehead(points);
    return points;
}

const std::vector<FeatureContour>& feature_contours() {
    static const std::vector<FeatureContour> contours = {
        outline(),
        {"mouth", counted(kFirstMarker, kFirstMarker + 7), std::vector<int>(8, 5), true},
        {"eye_right", counted(36, 41), {3, 4, 3, 3, 4, 3}, true},
        {"eye_left", counted(42, 47), {3, 4, 3, 3, 4, 3}, true},
        {"nose_bridge", {27, 28, 29, 30, kFirstMarker + 17}, {2, 2, 2, 1}, false},
        {"nose_base", counted(31, 35), {2, 2, 2, 2}, false}};
    return contours;
}

Flat contour_nodes(const FeatureContour& contour, const FeaturePoints& points) {
    const int total = std::accumulate(contour.steps.begin(), contour.steps.end(), contour.closed ? 0 : 1);
    Flat nodes(total, 2);
    int next = 0;
    for (int span = 0; span < static_cast<int>(contour.steps.size()); ++span) {
        const std::array<Vector2d, 4> p = {control(contour, points, span - 1), control(contour, points, span),
                                           control(contour, points, span + 1),
                                           control(contour, points, span + 2)};
        for (int step = 0; step < contour.steps[span]; ++step) {
            nodes.row(next++) = catmull_rom(p, static_cast<double>(step) / contour.steps[span]);
        }
    }
    if (!contour.closed) nodes.row(next) = points.row(contour.through.back());
    return nodes;
}

}  // namespace viaface
