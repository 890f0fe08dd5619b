// The lines that age draws: from the nose past the mouth's corners, over the forehead, between the brows,
// beside and under the eyes. Each is a bow seen from the front.
#pragma once

#include <vector>

#include "synth/training/bake.hpp"

namespace viaface {

class Creases {
  public:
    Creases(const Landmarks& landmarks, float age);  // age: 0 none, 1 deep

    float at(const Eigen::Vector3f& place) const;  // 0 none, about 1 in the bottom of a deep one

  private:
    struct Line {
        std::vector<Eigen::Vector2f> bow;
        float half_width, depth;    // mm, 0 to 1
        Eigen::Vector2f low, high;  // what it reaches
    };
    void add(const Eigen::Vector2f& from, const Eigen::Vector2f& over, const Eigen::Vector2f& to,
             float half_width, float depth);
    static float of(const Line& line, const Eigen::Vector2f& place);

    std::vector<Line> lines_;
    float age_;
};

}  // namespace viaface
