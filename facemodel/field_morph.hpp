// Field morphing: a plane is warped by pairs of directed lines. [Beier and Neely 1992; ATR98, reference 15]
//   u = (X - P).(Q - P) / |Q - P|^2,  v = (X - P).perp(Q - P) / |Q - P|,
//   X_i' = P' + u (Q' - P') + v perp(Q' - P') / |Q' - P'|,
//   X' = X + sum w_i (X_i' - X) / sum w_i,  w_i = (|Q - P|^p / (a + distance))^b
#pragma once

#include <Eigen/Core>
#include <vector>

namespace viaface {

struct MorphLine {
    Eigen::Vector2d from, to;
};

struct FieldMorphOptions {
    double a = 0.5;  // mm: how near a line gives way to its neighbours
    double b = 2;    // how fast a line's influence falls with distance
    double p = 0.5;  // how much more a longer line counts
};

class FieldMorph {
  public:
    // Line i of `source` goes to line i of `target`. std::invalid_argument when their numbers differ, there
    // is none, or a line has no length.
    FieldMorph(std::vector<MorphLine> source, std::vector<MorphLine> target, FieldMorphOptions options = {});

    Eigen::Vector2d operator()(const Eigen::Vector2d& place) const;

  private:
    std::vector<MorphLine> source_, target_;
    FieldMorphOptions options_;
};

}  // namespace viaface
