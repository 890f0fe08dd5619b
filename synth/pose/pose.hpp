// From a configuration of the points to every node of the face.
//   alpha = A p (18 face markers and the lower incisor)            [ATR98, eqs. 11-12]
//   f = mu + U alpha                                               [ATR98, eq. 14]
//   lips: outer contour = the skin's border nodes; middle and inner contour = rest + W d + E d, where d are
//   the displacements of the 16 lip points, W spreads them along the contours and E, learned from the
//   postures with a ridge, is what W leaves out. Then contact with the teeth and with each other. Teeth of
//   the lower jaw: rigid with the lower incisor. Tongue: with its points.
// Missing points (NaN) are first estimated from those that are there.
#pragma once

#include <memory>

#include "facemodel/estimator.hpp"
#include "facemodel/face.hpp"
#include "synth/pose/eye_ball.hpp"
#include "synth/pose/inside.hpp"
#include "synth/pose/training.hpp"

namespace viaface {

struct FacePose {
    Eigen::VectorXd coefficients;  // [modes], mm
};

struct LipShape {
    LipContours contours;  // before contact
};

struct Blink {
    double left = 0, right = 0;  // 0 open, 1 shut
};

// Immutable after construction: safe from any thread.
class Poser {
  public:
    // std::invalid_argument when face and training do not fit each other.
    Poser(const Face& face, const PoseTraining& training);
    ~Poser();
    Poser(Poser&&) noexcept;

    // Every point, the missing ones estimated. InputError("points", ...) when none is there.
    Configuration completed(const Configuration& points) const;
    FacePose face_pose(const Configuration& complete) const;
    LipShape lip_shape(const Configuration& complete, const FacePose& pose) const;

    // [nodes of the face x 3], mm, head frame. points: NaN where missing.
    Nodes posed(const Configuration& points, const Blink& blink = {}, const Gaze& gaze = {}) const;

    // The points as drawn, read off a posed mesh.
    Configuration drawn_points(const Nodes& posed) const;

    // Height of the drawn opening at the middle and halfway to the left and right corner, mm.
    std::array<double, 3> drawn_gaps(const Nodes& posed) const;

  private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

}  // namespace viaface
