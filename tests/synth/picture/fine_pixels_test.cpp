#include "synth/picture/fine_pixels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "facemodel/face.hpp"

namespace viaface {
namespace {

using raster::kSteps;

constexpr int kWidth = 150, kHeight = 60;

// Two squares side by side, of two triangles each: nodes 0 1 2 below, 3 4 5 above.
struct Sheet {
    std::vector<raster::Node> nodes;
    std::vector<raster::Facet> facets;
    std::vector<std::uint8_t> seen = std::vector<std::uint8_t>(4, 1);
    std::vector<int> weld = {0, 1, 2, 3, 4, 5};

    explicit Sheet(Material material, raster::Shade shade = raster::Shade::kSkin) {
        for (const int y : {10, 40}) {
            for (const int x : {20, 60, 100}) {
                nodes.emplace_back();
                nodes.back().place = {x * kSteps, y * kSteps, 0.001f};
            }
        }
        for (const auto& [a, b, c] :
             {std::array{0, 1, 4}, std::array{0, 4, 3}, std::array{1, 2, 5}, std::array{1, 5, 4}})
            facets.push_back({{a, b, c},
                              0,
                              std::uint8_t(material),
                              shade,
                              shade == raster::Shade::kInside,
                              false,
                              material != Material::kSkin});
    }

    raster::Bounds box_of(const raster::Facet& facet) const {
        const auto& [a, b, c] = facet.node;
        const auto [left, right] = std::minmax({nodes[a].place.x, nodes[b].place.x, nodes[c].place.x});
        const auto [bottom, top] = std::minmax({nodes[a].place.y, nodes[b].place.y, nodes[c].place.y});
        return {left / kSteps, bottom / kSteps, right / kSteps + 1, top / kSteps + 1};
    }

    bool fine(int x, int y, const raster::Bounds& opening = {0, 0, kWidth, kHeight}) const {
        FinePixels pixels(facets, weld, kWidth, kHeight);
        std::vector<raster::Bounds> boxes;
        for (const raster::Facet& facet : facets) boxes.push_back(box_of(facet));
        const raster::Bounds drawn{0, 0, kWidth, kHeight};
        std::vector<std::vector<VisibleFacet>> visible(1);
        find_visible({facets, boxes, seen, opening, drawn}, 0, int(facets.size()), visible[0]);
        WorkPool pool(1);
        pixels.find_outlines(seen, pool);
        pixels.mark(nodes, visible, drawn);
        return pixels.bits()[std::size_t(y) * pixels.words() + x / 64] >> (x % 64) & 1;
    }
};

TEST(FinePixels, AreThoseNearAnOutline) {
    const Sheet sheet(Material::kSkin);
    for (const int x : {19, 20, 99, 100}) EXPECT_TRUE(sheet.fine(x, 25)) << x;
    for (const int y : {9, 10, 39, 40}) EXPECT_TRUE(sheet.fine(70, y)) << y;
    for (const int x : {16, 24, 40, 60, 80, 96, 104}) EXPECT_FALSE(sheet.fine(x, 25)) << x;
}

TEST(FinePixels, AreWhereTheOtherTriangleIsTurnedAway) {
    Sheet sheet(Material::kSkin);
    sheet.seen = {1, 1, 0, 0};
    EXPECT_TRUE(sheet.fine(60, 25));
    EXPECT_TRUE(sheet.fine(59, 25));
    EXPECT_FALSE(sheet.fine(100, 25));
}

TEST(FinePixels, AreNotAlongSeamsOfTheTexture) {
    Sheet sheet(Material::kSkin);
    sheet.nodes.push_back(sheet.nodes[1]);
    sheet.nodes.push_back(sheet.nodes[4]);
    sheet.weld = {0, 1, 2, 3, 4, 5, 1, 4};
    for (int& node : sheet.facets[2].node) node = node == 1 ? 6 : node;
    for (int& node : sheet.facets[3].node) node = node == 1 ? 6 : node == 4 ? 7 : node;
    EXPECT_FALSE(sheet.fine(60, 25));
    std::iota(sheet.weld.begin(), sheet.weld.end(), 0);
    EXPECT_TRUE(sheet.fine(60, 25));
}

TEST(FinePixels, AreAllThatOtherMaterialsCover) {
    for (const auto& [material, shade] :
         {std::pair{Material::kLips, raster::Shade::kSkin}, std::pair{Material::kEye, raster::Shade::kEye}}) {
        const Sheet sheet(material, shade);
        EXPECT_TRUE(sheet.fine(40, 25));
        EXPECT_FALSE(sheet.fine(104, 25));
    }
}

TEST(FinePixels, InsideTheMouthAreSeenThroughTheOpening) {
    const Sheet sheet(Material::kTeeth, raster::Shade::kInside);
    EXPECT_TRUE(sheet.fine(40, 25, {30, 20, 50, 30}));
    EXPECT_FALSE(sheet.fine(70, 25, {30, 20, 50, 30}));
}

TEST(FinePixels, OutsideThePictureAreLeftOut) {
    Sheet sheet(Material::kLips);
    for (raster::Node& node : sheet.nodes) node.place.x -= 40 * kSteps, node.place.y += 30 * kSteps;
    EXPECT_TRUE(sheet.fine(0, 50));
    EXPECT_FALSE(sheet.fine(kWidth - 1, 50));
}

}  // namespace
}  // namespace viaface
