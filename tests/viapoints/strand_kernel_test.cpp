#include "viapoints/strand_kernel.hpp"

#include <gtest/gtest.h>

#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/basis.hpp"
#include "viapoints/knot_line.hpp"

namespace viaface {
namespace {

ViaPointTrack thinned(const AnalysisTarget& target, const StrandKernel& kernel) {
    KnotLine line(target, 0.5, 4, kernel);
    line.fill();
    line.thin();
    line.shift();
    line.thin();
    return line.track();
}

void expect_same_bytes(const AnalysisTarget& target) {
    const ViaPointTrack best = thinned(target, best_kernel()), baseline = thinned(target, baseline_kernel());
    EXPECT_EQ(best.time_s, baseline.time_s);
    EXPECT_EQ(best.points, baseline.points);
    EXPECT_LT(best.time_s.size(), target.time_s.size() / 2) << "a line that nothing has been done to";
}

TEST(StrandKernel, EveryInstructionSetGivesTheSameBytes) {
    for (const int points : {1, 7, 18}) {
        const Motion motion = smooth_motion(20, 6, 100, points);
        expect_same_bytes({motion.time_s, motion.positions.leftCols(3 * points)});
    }
}

TEST(StrandKernel, EveryInstructionSetGivesTheSameBytesForComponentsAndForOneCoordinate) {
    const Motion motion = smooth_motion(21, 6, 100, 18, 5);
    const ConfigurationBasis basis = principal_basis(motion.positions, 5);
    expect_same_bytes({motion.time_s, to_components(basis, motion.positions),
                       basis.modes.topRows(54).transpose(), RowMatrix::Zero(motion.positions.rows(), 54)});
    expect_same_bytes({motion.time_s, motion.positions.col(4)});
}

}  // namespace
}  // namespace viaface
