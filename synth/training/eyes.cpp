#include "synth/training/eyes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Vector3d;
constexpr int kEyeRings = 9, kEyeAround = 20;
constexpr double kLastAngle = 1.75;  // radians from straight ahead; the rest is never seen
constexpr int kLashRows = 4;

}  // namespace

PartMesh eye(double side, const EyeBall& ball) {
    constexpr int kNodes = kEyeRings * kEyeAround + 1;
    PartMesh part{side > 0 ? "eye_left" : "eye_right",
                  Material::kEye,
                  Drive::kFixed,
                  Nodes(kNodes, 3),
                  Uvs(kNodes, 2),
                  {}};
    for (int r = 0; r < kEyeRings; ++r) {
        const double angle = kLastAngle * std::pow((r + 1.0) / kEyeRings, 1.25);
        for (int k = 0; k < kEyeAround; ++k) {
            const double round = 2 * std::numbers::pi * k / kEyeAround;
            const Vector3d way(std::sin(angle) * std::cos(round), std::sin(angle) * std::sin(round),
                               std::cos(angle));
            part.nodes.row(r * kEyeAround + k) =
                (ball.centre + ball.size * EyeBall::radius_at(angle) * way).transpose();
            const double reach = angle / (2 * std::numbers::pi);
            part.uvs.row(r * kEyeAround + k) << static_cast<float>(0.5 + side * reach * std::cos(round)),
                static_cast<float>(0.5 + reach * std::sin(round));
        }
    }
    part.nodes.row(kNodes - 1) =
        (ball.centre + Vector3d(0, 0, ball.size * EyeBall::radius_at(0))).transpose();
    part.uvs.row(kNodes - 1) << 0.5f, 0.5f;
    const auto node = [](int r, int k) { return r * kEyeAround + k % kEyeAround; };
    for (int k = 0; k < kEyeAround; ++k) {
        part.triangles.push_back({kNodes - 1, node(0, k), node(0, k + 1)});
        for (int r = 0; r + 1 < kEyeRings; ++r) {
            part.triangles.push_back({node(r, k), node(r + 1, k), node(r + 1, k + 1)});
            part.triangles.push_back({node(r, k), node(r + 1, k + 1), node(r, k + 1)});
        }
    }
    return part;
}

Nodes lash_strip(const Nodes& roots, const EyeBall& ball, bool upper) {
    const auto count = static_cast<int>(roots.rows());
    constexpr double kShut = -0.30, kOpen = 0.02;  // height of an upper lash's root over its distance
    const double length = upper ? 8.0 : 4.6;
    Nodes strip(kLashRows * count, 3);
    for (int i = 0; i < count; ++i) {
        const Vector3d root = roots.row(i), out = (root - ball.centre).normalized();
        const Vector3d up = (Vector3d::UnitY() - out * out.y()).normalized();
        const double raised = std::clamp((out.y() - kShut) / (kOpen - kShut), 0.0, 1.0);
        const double curl = upper ? -0.20 + 0.92 * raised : -0.55;  // a shut lid's lashes hang
        const double along = (i + 0.5) / count;
        const double reach = length * (0.55 + 0.45 * std::sin(std::numbers::pi * (0.15 + 0.75 * along)));
        for (int r = 0; r < kLashRows; ++r) {
            const double t = static_cast<double>(r) / (kLashRows - 1);
            const Vector3d way =
                out * (t * (1 - 0.25 * t)) + up * (curl * t * t) + Vector3d(0, upper ? -0.15 * t : 0, 0);
            strip.row(r * count + i) = (root + reach * way).transpose();
        }
    }
    return strip;
}

PartMesh lashes(std::string name, const Nodes& strip, int roots, bool upper, bool mirrored) {
    const float first_v = upper ? 0 : 0.18f;  // below, roots do not show as a line
    PartMesh part{std::move(name), Material::kLash, Drive::kModes, strip, Uvs(strip.rows(), 2), {}};
    for (int r = 0; r < kLashRows; ++r) {
        for (int i = 0; i < roots; ++i) {
            part.uvs.row(r * roots + i) << static_cast<float>(i) / static_cast<float>(roots - 1),
                first_v + (1 - first_v) * static_cast<float>(r) / (kLashRows - 1);
            if (r + 1 == kLashRows || i + 1 == roots) continue;
            const int a = r * roots + i, b = a + 1, c = a + roots, d = c + 1;
            part.triangles.push_back(mirrored ? Triangle{a, c, d} : Triangle{a, d, c});
            part.triangles.push_back(mirrored ? Triangle{a, d, b} : Triangle{a, b, d});
        }
    }
    return part;
}

}  // namespace viaface
