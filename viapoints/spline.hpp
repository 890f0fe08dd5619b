// The minimum-jerk spline through via points: the minimiser of 1/2 integral of |x'''|^2 [ATR98, eq. 16]. Each
// segment is a quintic, joined C4; only the fifth derivative jumps. Departure: eq. 16 is planar, here any
// number of dimensions share one factorisation.
//
// Unknown are velocity and acceleration at each via point. With hL, hR the gaps to the neighbours - and +:
//   168/hL^3 v- + 24/hL^2 a- + 192(1/hL^3 + 1/hR^3) v + 36(1/hR^2 - 1/hL^2) a + 168/hR^3 v+ - 24/hR^2 a+
//       = 360 [(p - p-)/hL^4 + (p+ - p)/hR^4]
//   -24/hL^2 v- - 3/hL a- + 36(1/hR^2 - 1/hL^2) v + 9(1/hL + 1/hR) a + 24/hR^2 v+ - 3/hR a+
//       = 60 [(p+ - p)/hR^3 - (p - p-)/hL^3]
// A natural end lacks the side beyond it; a clamped end's rows are dropped and its known values moved to the
// right. The matrix M is symmetric positive definite and block tridiagonal; D^-1/2 M D^-1/2, D its diagonal,
// is what is factored.
//
// Two via points with natural ends leave a parabola's bend free at no cost: the straight line is taken.
//
// Dimensions do not mix: a column that holds NaN is NaN throughout and leaves the others as they are.
#pragma once

#include <memory>
#include <vector>

#include "viapoints/track.hpp"

namespace viaface {

// What holds at an end: natural (x''' = x'''' = 0), or velocity and acceleration given.
struct SplineEnd {
    enum class Kind { kNatural, kClamped } kind = Kind::kNatural;
    Eigen::VectorXd velocity = {};      // [dimensions], per s; empty when natural, or at rest (zero)
    Eigen::VectorXd acceleration = {};  // [dimensions], per s^2; likewise

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
        RowMatrix velocity, acceleration;  // [via points x dimensions], per s, per s^2
    };
    // std::invalid_argument when shapes do not agree, or an end's kind is not the one that was factored.
    Derivatives solve(const RowMatrix& points, const SplineEnd& first, const SplineEnd& last) const;

  private:
    struct Block;
    RowMatrix right_side(const RowMatrix& points, const SplineEnd& first, const SplineEnd& last) const;

    std::vector<double> time_s_;
    std::shared_ptr<const std::vector<Block>> factor_;
    SplineEnd::Kind first_, last_;
};

class MinimumJerkSpline {
  public:
    explicit MinimumJerkSpline(ViaPointTrack track, SplineEnd first = SplineEnd::natural(),
                               SplineEnd last = SplineEnd::natural());

    // The n-th derivative (0 to 5) at time t; outside the track's span the end's value is held (derivatives
    // are 0). At a via time the fifth is that of the segment after it (at the last one, before it).
    // std::invalid_argument for other n, or NaN t.
    Eigen::VectorXd at(double time_s, int derivative = 0) const;
    // [times x dimensions], in one sweep: O(via points + times). std::invalid_argument when a time is less
    // than the one before.
    RowMatrix at(const std::vector<double>& times_s, int derivative = 0) const;
    double jerk_cost() const;  // 1/2 integral of |x'''|^2 over the span, exact; columns with NaN are left out

    const ViaPointTrack& track() const { return track_; }
    const RowMatrix& velocity() const { return via_.velocity; }          // [via points x dimensions], per s
    const RowMatrix& acceleration() const { return via_.acceleration; }  // [via points x dimensions], per s^2

  private:
    Eigen::RowVectorXd in_segment(std::size_t segment, double time_s, int derivative) const;

    ViaPointTrack track_;
    MinimumJerkSystem::Derivatives via_;
};

}  // namespace viaface
