// Channels of the gestural model to shapes of a blend-shape head, and so to the layout's points: how the
// built-in talker performs phones. Linear in the shapes, so that every configuration lies in their span;
// mildly nonlinear where the shapes are made to be combined:
//   - protrusion and width solve a 2x2 system in a rounding shape and mouthStretch; the rounding shape passes
//     from mouthPucker (closed lips) to mouthFunnel (open lips) as the lips open;
//   - mouthRollLower tucks the lower lip; in a full tuck it also takes back what the other shapes move its
//   edge forward;
//   - what these, jawOpen and mouthRollLower leave of the lips' heights is made up by mouthUpperUp, and by
//   mouthLowerDown downwards or
//     upwards by mouthClose as far as the jaw is open (it undoes jawOpen) and mouthShrugLower beyond.
// Every passage is smooth. The tongue of the head does not move: its points are rest plus channels.
#pragma once

#include "synth/training/blend_head.hpp"
#include "synth/training/gestures.hpp"

namespace viaface {

class Performer {
  public:
    explicit Performer(const BlendHead& head);

    using Channels = Eigen::Matrix<double, kChannels, 1>;  // mm from rest
    ShapeWeights weights(const Channels& channels) const;
    Configuration configuration(const Channels& channels) const;
    Motion perform(const PhoneSequence& phones) const;  // at kGestureRate

    const Configuration& rest() const { return rest_; }  // the neutral head's, its lips a little apart
    Configuration resting() const;                       // lips together, as in a pause

  private:
    enum Shape {
        kJawOpen,
        kPucker,
        kFunnel,
        kStretch,
        kRollLower,
        kUpperUp,
        kLowerDown,
        kClose,
        kShrugLower
    };
    static constexpr int kShapes = 9;
    using Weights = Eigen::Matrix<double, kShapes, 1>;

    double height(Point point, const Weights& weights) const;  // mm from rest
    double moved(Shape shape, Point point, int axis) const { return delta_(3 * point + axis, shape); }
    Weights solve(const Channels& channels) const;
    void round_lips(const Channels& channels, Weights& weights) const;
    void tuck_lip(const Channels& channels, Weights& weights) const;
    void raise_lips(const Channels& channels, Weights& weights) const;

    Configuration rest_;
    Eigen::Matrix<double, kCoordinates, kShapes> delta_;  // of the points, per unit of weight
};

}  // namespace viaface
