#include "synth/picture/changed_bands.hpp"

#include <gtest/gtest.h>

namespace viaface {
namespace {

bool holds(const Rect& rect, const Extent& extent) {
    return (Extent::of(rect).bounds <= extent.bounds).all();
}

Extent extent(float left, float right, float bottom, float top) { return {{left, bottom, -right, -top}}; }

TEST(Extent, TouchesWhatItLiesOver) {
    const Extent middle = extent(10, 20, 30, 40);
    EXPECT_TRUE(touch(middle, extent(19, 25, 0, 31)));
    EXPECT_TRUE(touch(middle, extent(12, 13, 33, 34)));
    for (const Extent& beside :
         {extent(20, 25, 30, 40), extent(0, 10, 30, 40), extent(10, 20, 40, 50), extent(10, 20, 0, 30)}) {
        EXPECT_FALSE(touch(middle, beside));
        EXPECT_FALSE(touch(beside, middle));
    }
}

TEST(Extent, OfATriangleHoldsItsCorners) {
    const Eigen::Vector2f a(3, 50), b(-4, 20), c(9, 21);
    const Extent of_all = extent_of(Extent::of(a), Extent::of(b), Extent::of(c));
    EXPECT_TRUE((of_all.bounds < extent(-4, 9, 20, 50).bounds).all());
    EXPECT_TRUE((of_all.bounds > extent(-7, 12, 17, 53).bounds).all());
}

TEST(ChangedBands, NothingMarkedNothingTaken) { EXPECT_TRUE(ChangedBands(100, 100).take().empty()); }

TEST(ChangedBands, HoldsWhatIsMarkedOnce) {
    ChangedBands bands(200, 200);
    const Extent low = extent(20.5f, 60.2f, 10.1f, 30.7f), high = extent(100, 120, 150, 160);
    bands.mark(low);
    bands.mark(high);
    const std::vector<Rect> rects = bands.take();
    ASSERT_EQ(rects.size(), 2u);
    EXPECT_TRUE(holds(rects[0], low));
    EXPECT_TRUE(holds(rects[1], high));
    EXPECT_LT(rects[0].width * rects[0].height + rects[1].width * rects[1].height, 200 * 200 / 4);
    EXPECT_TRUE(bands.take().empty());
}

TEST(ChangedBands, TakesOverWhatAnotherHolds) {
    ChangedBands bands(200, 200), other(200, 200);
    bands.mark(extent(10, 20, 10, 20));
    other.mark(extent(100, 120, 150, 160));
    bands.take_from(other);
    EXPECT_EQ(bands.take().size(), 2u);
    EXPECT_TRUE(other.take().empty());
}

TEST(ChangedBands, StaysInsideThePicture) {
    ChangedBands bands(100, 50);
    bands.mark(extent(-500, 500, -500, 500));
    bands.mark(extent(-50, -40, 0, 10));
    const std::vector<Rect> rects = bands.take();
    ASSERT_EQ(rects.size(), 1u);
    EXPECT_EQ(rects[0].left, 0);
    EXPECT_EQ(rects[0].bottom, 0);
    EXPECT_EQ(rects[0].width, 100);
    EXPECT_EQ(rects[0].height, 50);
}

}  // namespace
}  // namespace viaface
