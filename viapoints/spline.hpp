// The minimum-jerk spline through via points: the minimiser of 1/2 integral of |x'''|^2 [ATR98, eq. 16]. Each
// segment is a quintic, joined C4; only the fifth derivative jumps. Departure: eq. 16 is planar, here any
// number of dimensions share one factorisation.
#pragma once

#include <memory>
#include <vector>

#include "viapoints/track.hpp"

namespace viaface {

// What holds at an end: natural (x''' = x'''' = 0), or velocity and acceleration given.
struct SplineEnd {
    enum class Kind { kNatural, kClamped } kind = Kind::kNatural;
    Eigen::VectorXd velocity = {},
                    acceleration =
                        {};  // [dimensions], per s and per s^2; empty when natural, or at rest (zero)

    static SplineEnd natural() { return {}; }
    static SplineEnd at_rest() { return {Kind::kClamped, {}, {}}; }
};

// The block tridiagonal system of one set of via times, scaled and factored once; solve is const and
// thread-safe, O(n) per dimension. Throws std::invalid_argument for fewer than two times, or times not
// strictly rising or not finite.
class MinimumJerkSystem {
  public:
    MinimumJerkSystem(std::vector<double> time_s, SplineEnd::Kind first, SplineEnd::Kind last);

    struct Derivatives {
        RowMatrix velocity, acceleration;
    };  // [via points x dimensions], per s, per s^2
    Derivatives solve(const RowMatrix& points, const SplineEnd& first, const SplineEnd& last) const;

  private:
    struct Block;
    std::vector<double> time_s_;
    std::shared_ptr<const std::vector<Block>> factor_;
    bool first_clamped_, last_clamped_;
};

class MinimumJerkSpline {
  public:
    explicit MinimumJerkSpline(ViaPointTrack track, SplineEnd first = SplineEnd::natural(),
                               SplineEnd last = SplineEnd::natural());

    // The n-th derivative (0 to 5) at time t; outside the track's span the end's value is held (derivatives
    // are 0).
    Eigen::VectorXd at(double time_s, int derivative = 0) const;
    RowMatrix at(const std::vector<double>& times_s) const;  // [times x dimensions]
    double jerk_cost() const;                                // 1/2 integral of |x'''|^2, exact

    const ViaPointTrack& track() const { return track_; }

  private:
    ViaPointTrack track_;
    RowMatrix velocity_, acceleration_;
};

}  // namespace viaface
