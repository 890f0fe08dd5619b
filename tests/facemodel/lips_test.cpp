#include "facemodel/lips.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace viaface {
namespace {

// Lips as an oval ring that tapers inwards, moved up and forth.
Nodes ring_of_lips(double up, double forth) {
    Nodes rows(LipGrid::kRows * LipGrid::kColumns, 3);
    for (int row = 0; row < LipGrid::kRows; ++row) {
        const double size = 1 - 0.6 * row / (LipGrid::kRows - 1);
        for (int c = 0; c < LipGrid::kColumns; ++c) {
            const double angle = std::numbers::pi * (0.5 - 2.0 * c / LipGrid::kColumns);
            rows.row(row * LipGrid::kColumns + c) << 25 * size * std::cos(angle),
                12 * size * std::sin(angle) + up, 8 - 9.0 * row / (LipGrid::kRows - 1) + forth;
        }
    }
    return rows;
}

// Lips slide over an edge of teeth in steps of 0.01 mm. No node goes more than 0.2 mm at a step: the steepest
// of the blended ways out rises 12 to 1.
TEST(Lips, DoNotJumpAsTheyPassTheTeeth) {
    constexpr double kStep = 0.01, kMost = 0.2;  // mm
    for (const double side : {1.0, -1.0}) {
        const TeethFront teeth{1.6, 0.026, 0, side, 2};
        double most_moved = 0;
        for (const double forth : {-3.0, -1.0, 0.5, 2.0}) {
            Nodes before;
            for (int n = 0; n <= 1600; ++n) {
                const Nodes asked = ring_of_lips(-8 + kStep * n, forth);
                Nodes rows = asked;
                keep_off_teeth(rows, teeth);
                most_moved = std::max(most_moved, (rows - asked).rowwise().norm().maxCoeff());
                if (n > 0) {
                    ASSERT_LT((rows - before).rowwise().norm().maxCoeff(), kMost) << n << " forth " << forth;
                }
                before = rows;
            }
        }
        EXPECT_GT(most_moved, 1);
    }
}

}  // namespace
}  // namespace viaface
