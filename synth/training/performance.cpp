#include "synth/training/performance.hpp"

#include <Eigen/LU>
#include <cmath>

namespace viaface {
namespace {

constexpr const char* kShapeNames[] = {"jawOpen",        "mouthPucker",    "mouthFunnel",
                                       "mouthStretch",   "mouthRollLower", "mouthUpperUp",
                                       "mouthLowerDown", "mouthClose",     "mouthShrugLower"};
constexpr int kX = 0, kY = 1, kZ = 2;

constexpr double kMostFunnel = 0.35;                  // share of the rounding when the lips are far open
constexpr double kFunnelGap = 4, kFunnelPassage = 3;  // mm: gap of half that share, and how gently it comes
constexpr double kSplitWidth = 0.25;                  // mm: how gently up passes into down
constexpr double kFullTuck = 6;     // mm: where the lip's edge is held against all that moves it forward
constexpr int kPasses = 4;          // tuck and height settle by a factor of 4 in each
constexpr double kRearShare = 0.7;  // of the tongue body's way, followed by its rear

double smooth_positive(double x) {
    return (x + std::sqrt(x * x + 4 * kSplitWidth * kSplitWidth)) / 2 - kSplitWidth;
}
double smooth_least(double a, double b) { return a - smooth_positive(a - b); }

}  // namespace

Performer::Performer(const BlendHead& head) : rest_(head.points(head.neutral().nodes)) {
    for (int shape = 0; shape < kShapes; ++shape) {
        delta_.col(shape) = head.points(head.pose({{kShapeNames[shape], 1.0}})) - rest_;
    }
}

double Performer::height(Point point, const Weights& weights) const {
    return delta_.row(3 * point + kY).dot(weights);
}

void Performer::round_lips(const Channels& channels, Weights& weights) const {
    const auto forward = [&](Shape s) {
        return (moved(s, kBorderTop, kZ) + moved(s, kBorderBottom, kZ)) / 2;
    };
    const auto wider = [&](Shape s) { return moved(s, kBorderLeft, kX) - moved(s, kBorderRight, kX); };
    const double gap = point_of(rest_, kInnerTop).y() - point_of(rest_, kInnerBottom).y() +
                       channels(kUpperLip) - channels(kLowerLip);
    const double funnel = kMostFunnel * (0.5 + 0.5 * std::tanh((gap - kFunnelGap) / kFunnelPassage));
    const double pucker = 1 - funnel;
    Eigen::Matrix2d system;
    system << pucker * forward(kPucker) + funnel * forward(kFunnel), forward(kStretch),
        pucker * wider(kPucker) + funnel * wider(kFunnel), wider(kStretch);
    const Eigen::Vector2d solved =
        system.inverse() * Eigen::Vector2d(channels(kProtrusion), channels(kWidth));
    weights(kPucker) = pucker * solved(0);
    weights(kFunnel) = funnel * solved(0);
    weights(kStretch) = solved(1);
}

void Performer::raise_lips(const Channels& channels, Weights& weights) const {
    for (const Shape own : {kUpperUp, kClose, kShrugLower, kLowerDown}) weights(own) = 0;
    const double upper = channels(kUpperLip) - height(kInnerTop, weights);
    weights(kUpperUp) = upper / moved(kUpperUp, kInnerTop, kY);
    const double lower = channels(kLowerLip) - height(kInnerBottom, weights);
    const double up = smooth_positive(lower);
    const double with_jaw = smooth_least(up, channels(kJaw));
    weights(kClose) = with_jaw / moved(kClose, kInnerBottom, kY);
    weights(kShrugLower) = (up - with_jaw) / moved(kShrugLower, kInnerBottom, kY);
    weights(kLowerDown) = (lower - up) / moved(kLowerDown, kInnerBottom, kY);
}

void Performer::tuck_lip(const Channels& channels, Weights& weights) const {
    weights(kRollLower) = 0;
    const double forward = delta_.row(3 * kInnerBottom + kZ).dot(weights);
    const double backward = channels(kTuck) + channels(kTuck) / kFullTuck * forward;
    weights(kRollLower) = -backward / moved(kRollLower, kInnerBottom, kZ);
}

Performer::Weights Performer::solve(const Channels& channels) const {
    Weights weights = Weights::Zero();
    weights(kJawOpen) = -channels(kJaw) / moved(kJawOpen, kLowerIncisor, kY);
    round_lips(channels, weights);
    for (int pass = 0; pass < kPasses; ++pass) {
        tuck_lip(channels, weights);
        raise_lips(channels, weights);
    }
    return weights;
}

ShapeWeights Performer::weights(const Channels& channels) const {
    const Weights solved = solve(channels);
    ShapeWeights named;
    for (int shape = 0; shape < kShapes; ++shape) named[kShapeNames[shape]] = solved(shape);
    return named;
}

Configuration Performer::configuration(const Channels& channels) const {
    Configuration c = rest_ + delta_ * solve(channels);
    const auto place = [&](Point point, double up, double forward) {
        c.segment<3>(3 * point) = point_of(rest_, point) + Eigen::Vector3d(0, up, forward);
    };
    place(kTongueTip, channels(kTipHeight), channels(kTipAdvance));
    place(kTongueBody, channels(kBodyHeight), channels(kBodyAdvance));
    place(kTongueRear, kRearShare * channels(kBodyHeight), kRearShare * channels(kBodyAdvance));
    return c;
}

Configuration Performer::resting() const {
    const auto channels = resting_channels();
    return configuration(Eigen::Map<const Channels>(channels.data()));
}

Motion Performer::perform(const PhoneSequence& phones) const {
    const ChannelMotion channels = gesture(phones);
    Motion motion{channels.time_s, RowMatrix(channels.channels.rows(), kCoordinates)};
    for (Eigen::Index k = 0; k < channels.channels.rows(); ++k) {
        motion.positions.row(k) = configuration(channels.channels.row(k).transpose()).transpose();
    }
    return motion;
}

}  // namespace viaface
