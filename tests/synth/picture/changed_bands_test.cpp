#include "synth/picture/changed_bands.hpp"

#include <gtest/gtest.h>

namespace viaface {
namespace {

bool holds(const Rect& rect, const Extent& e) {
    return rect.left <= e.left && rect.bottom <= e.bottom && rect.left + rect.width >= e.right &&
           rect.bottom + rect.height >= e.top;
}

TEST(ChangedBands, NothingMarkedNothingTaken) { EXPECT_TRUE(ChangedBands(100, 100).take().empty()); }

TEST(ChangedBands, HoldsWhatIsMarkedOnce) {
    ChangedBands bands(200, 200);
    const Extent low{20.5f, 60.2f, 10.1f, 30.7f}, high{100, 120, 150, 160};
    bands.mark(low);
    bands.mark(high);
    const std::vector<Rect> rects = bands.take();
    ASSERT_EQ(rects.size(), 2u);
    EXPECT_TRUE(holds(rects[0], low));
    EXPECT_TRUE(holds(rects[1], high));
    EXPECT_LT(rects[0].width * rects[0].height + rects[1].width * rects[1].height, 200 * 200 / 4);
    EXPECT_TRUE(bands.take().empty());
}

TEST(ChangedBands, StaysInsideThePicture) {
    ChangedBands bands(100, 50);
    bands.mark({-500, 500, -500, 500});
    bands.mark({-50, -40, 0, 10});
    const std::vector<Rect> rects = bands.take();
    ASSERT_EQ(rects.size(), 1u);
    EXPECT_EQ(rects[0].left, 0);
    EXPECT_EQ(rects[0].bottom, 0);
    EXPECT_EQ(rects[0].width, 100);
    EXPECT_EQ(rects[0].height, 50);
}

}  // namespace
}  // namespace viaface
