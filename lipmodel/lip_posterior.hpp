// How probable a lip shape is, given the colours of a picture and the learned modes. [Basu98, eqs. 12-24]
//   log f(p|O) = sum over faces n of gamma A_n log f_class(n)(x_n, y_n) - 1/2 sum p_i^2 / lambda_i + D,
// with (x_n, y_n) the image of the face's centroid and A_n its visible area in px^2 (0 when it is turned
// away); lips are the faces within the border, skin those around. Its gradient, areas and visibility as they
// are (eqs. 22-24): sum gamma A_n d log f/d(x, y) d(x, y)/dp - p / lambda.
// Departures: what opens between the lips is a third class, or nothing would speak
// against a mouth drawn too wide; the centroids' slope is the pinhole's own where the paper takes the modes
// turned and scaled; and the pose, which the paper fits by hand, may climb too, held by a Gaussian about the
// pose that is expected.
#pragma once

#include <vector>

#include "lipmodel/class_maps.hpp"
#include "lipmodel/coloured_faces.hpp"
#include "lipmodel/modes.hpp"

namespace viaface {

// How far the pose may be from the one expected: standard deviations; 0 holds it there.
struct PoseFreedom {
    double turn = 0;   // radians, about each axis of the camera
    double shift = 0;  // mm, along each
    double scale = 0;  // of the logarithm of each scale
};

// Over the parameters theta: p, then what of turn, shift and log scale is free, each relative to the pose
// expected: X_c = exp(turn) (X_c expected - shift expected) + ... Immutable; the model and the maps have to
// outlive it.
class LipPosterior {
  public:
    // gamma: how much each px^2 counts; the maps' own independence, or less.
    LipPosterior(const LipModel& model, const Pinhole& camera, const LipPose& expected, const ClassMaps& maps,
                 double gamma, const PoseFreedom& freedom = {});

    Eigen::Index parameters() const { return certainty_.size(); }
    Eigen::VectorXd start(const Eigen::VectorXd& p) const;  // theta at the pose expected
    Eigen::VectorXd modes_of(const Eigen::VectorXd& theta) const { return theta.head(model_.modes.cols()); }
    LipPose pose_of(const Eigen::VectorXd& theta) const;

    double value(const Eigen::VectorXd& theta) const;           // eqs. 17-19
    Eigen::VectorXd areas(const Eigen::VectorXd& theta) const;  // A_n [faces], px^2
    double value_at_areas(const Eigen::VectorXd& theta, const Eigen::VectorXd& areas) const;
    double mean_fit(const Eigen::VectorXd& theta) const;  // exp of the mean of log f over the area, 0 to 1
    // One row per face: gamma A_n d log f_n / d theta [faces x parameters]; the sum of rows is eq. 23.
    Eigen::MatrixXd face_slopes(const Eigen::VectorXd& theta) const;
    Eigen::VectorXd gradient(const Eigen::VectorXd& theta) const;  // eqs. 21-24
    // The direction of ascent: the gradient in the metric of the prior's certainty plus the sum of
    // s s^t / (gamma A_n) over the faces' slopes s, in which modes that the picture tells clearly and modes
    // that it tells badly climb alike.
    Eigen::VectorXd ascent(const Eigen::VectorXd& theta) const;

  private:
    struct Free {
        Eigen::Index turn = -1, shift = -1, scale = -1;  // first place in theta; -1 when held
    };
    Projected projected(const Eigen::VectorXd& theta) const;
    Eigen::VectorXd areas_of(const Projected& seen) const;
    double value_of(const Eigen::VectorXd& theta, const Projected& seen, const Eigen::VectorXd& areas) const;
    const LogMap& map_of(ColourClass colour) const;
    Eigen::Vector3d at(const Eigen::VectorXd& theta, Eigen::Index first) const;
    Eigen::MatrixXd slopes_of(const Eigen::VectorXd& theta, const Projected& seen,
                              const Eigen::VectorXd& areas) const;

    const LipModel& model_;
    const ClassMaps& maps_;
    Pinhole camera_;
    LipPose expected_;
    double gamma_;
    const std::vector<ColouredFace>& faces_;
    Eigen::MatrixXd face_modes_;  // [3 faces x M]: modes at the centroids, head frame
    Free free_;
    Eigen::VectorXd certainty_;  // [parameters] of the prior: 1 / lambda, 1 / sd^2
};

}  // namespace viaface
