// How a head moves in the picture: the part of the face that speech leaves still, from the brows to the nose,
// laid over each new picture by a similarity with gain and offset of its brightness (inverse compositional
// Gauss-Newton [BakerMatthews04]). The paper keeps the head rigid and names head tracking as the next step.
#pragma once

#include <vector>

#include "lipmodel/class_maps.hpp"

namespace viaface {

// now = centre + [a -b; b a] (then - centre) + shift
struct Similarity {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // px, in the first picture
    double a = 1, b = 0;
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();  // px

    Eigen::Vector2d operator()(const Eigen::Vector2d& then) const;
    double scale() const;
    double roll() const;  // radians, clockwise in the picture
};

struct Followed {
    Similarity move;
    double likeness = 0;  // correlation of what is there now with what was, -1 to 1
};

// Immutable.
class HeadFollower {
  public:
    static constexpr int kLeastSide = 8;  // px, of a patch

    // patch: what to follow; std::invalid_argument when it is smaller or does not lie in the picture.
    HeadFollower(const Picture& first, const PictureBox& patch);

    Followed follow(const Picture& now, const Similarity& start) const;
    Similarity still() const { return {.centre = centre_}; }

  private:
    Eigen::Vector2d centre_;
    std::vector<Eigen::Vector2d> places_;  // relative to the centre
    Eigen::VectorXd brightness_;           // [places]
    Eigen::MatrixXd slopes_;               // [places x 6]: shift, a, b, gain, offset
    Eigen::MatrixXd solver_;               // [6 x places]
};

}  // namespace viaface
