#include "synth/training/left_out.hpp"

#include "talker.hpp"

namespace viaface {
namespace {

TEST(LeftOut, APostureIsDrawnWorseByAFaceThatHasNotSeenIt) {
    SKIP_WITHOUT_SCANS();
    const auto& talker = test_talker();
    const std::vector<Posture> some = {
        posture("closed_relaxed"), posture("a"), posture("i"), posture("u"), posture("o"),
        posture("mouth_open")};
    const auto left_out = left_out_distances(talker.source, some),
               seen = unseen_distances(talker.source, some, some);
    ASSERT_EQ(left_out.size(), some.size());
    for (std::size_t k = 0; k < some.size(); ++k) {
        EXPECT_EQ(left_out[k].name, some[k].name);
        EXPECT_GT(left_out[k].mean_mm, seen[k].mean_mm) << some[k].name;
        EXPECT_LE(left_out[k].mean_mm, left_out[k].ninety_fifth_mm);
        EXPECT_LE(left_out[k].ninety_fifth_mm, left_out[k].largest_mm);
    }
}

}  // namespace
}  // namespace viaface
