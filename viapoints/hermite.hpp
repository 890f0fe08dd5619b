// The quintic that is given by position, velocity and acceleration at both ends of one segment; with x = s/h
// in [0, 1]:
//   p1: 10x^3 - 15x^4 + 6x^5 (p0: one minus that), v0: h(x - 6x^3 + 8x^4 - 3x^5), v1: h(-4x^3 + 7x^4 - 3x^5),
//   a0: h^2/2 (x^2 - 3x^3 + 3x^4 - x^5), a1: h^2/2 (x^3 - 2x^4 + x^5).
// p1's polynomial is the minimum-jerk stroke between two rests [FH85, eq. 10].
#pragma once

#include <array>

namespace viaface {

// How much each end value weighs in the n-th derivative (0 to 5) at x.
struct HermiteWeights {
    double p0, v0, a0, p1, v1, a1;
};

inline HermiteWeights hermite_weights(double h, double x, int derivative) {
    using Quintic = std::array<double, 6>;  // coefficients of 1, x, ... x^5
    constexpr Quintic kP1{0, 0, 0, 10, -15, 6}, kV0{0, 1, 0, -6, 8, -3}, kV1{0, 0, 0, -4, 7, -3};
    constexpr Quintic kA0{0, 0, .5, -1.5, 1.5, -.5}, kA1{0, 0, 0, .5, -1, .5};
    const auto at = [&](const Quintic& c) {
        double sum = 0;
        for (int k = 5; k >= derivative; --k) {
            double factor = c[static_cast<std::size_t>(k)];
            for (int j = 0; j < derivative; ++j) factor *= k - j;
            sum = sum * x + factor;
        }
        for (int j = 0; j < derivative; ++j) sum /= h;
        return sum;
    };
    const double p1 = at(kP1);
    const double p0 = derivative == 0 ? 1 - p1 : -p1;
    return {p0, h * at(kV0), h * h * at(kA0), p1, h * at(kV1), h * h * at(kA1)};
}

}  // namespace viaface
