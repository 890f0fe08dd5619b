#include "viapoints/layout.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace viaface {
namespace {

TEST(Layout, TableInLayoutMdIsTheOneInCode) {
    std::ifstream in(std::string(VIAFACE_SOURCE_DIR) + "/viapoints/LAYOUT.md");
    std::string line;
    int rows = 0;
    while (std::getline(in, line)) {
        int index = 0;
        std::string bar, name;
        std::istringstream cells(line);
        if (!(cells >> bar >> index >> bar >> name)) continue;
        ASSERT_EQ(index, rows);
        EXPECT_EQ(name, point_name(index));
        ++rows;
    }
    EXPECT_EQ(rows, kPoints);
}

TEST(Layout, NamesAndIndicesAreInverse) {
    for (int i = 0; i < kPoints; ++i) EXPECT_EQ(point_index(point_name(i)), i);
    EXPECT_EQ(point_index("elbow"), std::nullopt);
    EXPECT_EQ(point_name(kNose), "nose");
    EXPECT_EQ(point_name(kBorderTop), "border_top");
    EXPECT_EQ(point_name(kInnerTop), "inner_top");
    EXPECT_EQ(point_name(kTongueRear), "tongue_rear");
}

TEST(Layout, MirroringTwiceIsTheSamePoint) {
    for (int i = 0; i < kPoints; ++i) EXPECT_EQ(mirrored_point(mirrored_point(i)), i);
    EXPECT_EQ(mirrored_point(kLipBottomLeft), kLipBottomRight);
    EXPECT_EQ(mirrored_point(kInnerTop), kInnerTop);
}

}  // namespace
}  // namespace viaface
