#include "synth/pose/head_sway.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "facemodel/remesh.hpp"

namespace viaface {
namespace {

constexpr double kHertz[] = {0.11, 0.27, 0.62}, kHeights[] = {0.55, 0.30, 0.15};  // heights sum to 1
constexpr double kOfAxis[] = {1, 2.0 / 3, 0.5};
constexpr double kRadians = std::numbers::pi / 180;

constexpr double kSlope = 0.33, kFoot = -112;  // the foot of the neck: y + slope z = foot, mm
constexpr double kNeck = 38;                   // mm above its foot: the head

double smooth(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace

HeadSway::HeadSway(double amplitude, std::uint64_t seed) : axes_{} {
    if (!(amplitude >= 0 && amplitude <= kWidest))
        throw InputError("head_motion", std::to_string(amplitude), "0 to 10 degrees");
    Dice dice(seed ^ 0x68656164u);
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
        for (std::size_t k = 0; k < kWaves; ++k) {
            axes_[axis][k] = {amplitude * kOfAxis[axis] * kHeights[k], kHertz[k] * (0.8 + 0.4 * dice.unit()),
                              2 * std::numbers::pi * dice.unit()};
        }
    }
}

HeadTurn HeadSway::at(double time_s) const {
    const auto sum = [&](const std::array<Wave, kWaves>& waves) {
        double angle = 0;
        for (const auto& [height, frequency, phase] : waves)
            angle += height * std::sin(2 * std::numbers::pi * frequency * time_s + phase);
        return angle;
    };
    return {sum(axes_[0]), sum(axes_[1]), sum(axes_[2])};
}

Neck::Neck(const Face& face) {
    for (Eigen::Index i = 0; i < face.rest.rows(); ++i) {
        const double above = face.rest(i, 1) + kSlope * face.rest(i, 2) - kFoot;
        shares_.push_back(static_cast<float>(smooth(above / kNeck)));
    }
}

void Neck::turn(Nodes& posed, const HeadTurn& turn) const {
    if (turn == HeadTurn{}) return;
    const auto rotation = [&](double share) -> Eigen::Matrix3d {
        return (Eigen::AngleAxisd(share * turn.roll * kRadians, Vector3d::UnitZ()) *
                Eigen::AngleAxisd(share * turn.left * kRadians, Vector3d::UnitY()) *
                Eigen::AngleAxisd(-share * turn.up * kRadians, Vector3d::UnitX()))
            .toRotationMatrix();
    };
    const Eigen::Matrix3d whole = rotation(1);
    for (Eigen::Index i = 0; i < posed.rows(); ++i) {
        const float share = shares_[static_cast<std::size_t>(i)];
        if (share == 0) continue;
        const Vector3d from = posed.row(i).transpose() - kNeckPivot;
        posed.row(i) = (kNeckPivot + (share == 1 ? whole : rotation(share)) * from).transpose();
    }
}

}  // namespace viaface
