#include "synth/training/bake.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "simple_faces.hpp"
#include "synth/training/bake_noise.hpp"
#include "synth/training/bake_occlusion.hpp"
#include "synth/training/bake_texels.hpp"

namespace viaface {
namespace {

using testing::add_ball;
using testing::add_square;

// A square over the middle half of its texture, both ways.
Face mapped_square(double nearer = 0) {
    Face face;
    add_square(face, Material::kSkin, 100, nearer);
    face.uvs << 0.25f, 0.25f, 0.75f, 0.25f, 0.75f, 0.75f, 0.25f, 0.75f;
    return face;
}

TEST(Bake, TexelsCoverTheirTriangles) {
    const Face face = mapped_square();
    const TexelGrid grid = lay_out(face, Material::kSkin, 64);
    const auto covered = std::ranges::count_if(grid.texels, [](const Texel& t) { return t.part == 0; });
    EXPECT_EQ(covered, 32 * 32);
    for (const Texel& t : grid.texels) {
        if (t.part < 0) continue;
        EXPECT_NEAR(t.place.x(), -50 + (t.u - 0.25) * 200, 1e-3);
        EXPECT_NEAR(t.place.y(), testing::kMiddleY - 50 + (t.v - 0.25) * 200, 1e-3);
        EXPECT_NEAR(t.normal.z(), 1, 1e-6);
        EXPECT_NEAR(t.along_u.x(), 1, 1e-6);
        EXPECT_NEAR(t.along_v.y(), 1, 1e-6);
    }
}

TEST(Bake, SpreadingFillsARimAndNothingElse) {
    const Face face = mapped_square();
    const TexelGrid grid = lay_out(face, Material::kSkin, 64);
    Texture texture{64, 64, 3, std::vector<std::uint8_t>(64 * 64 * 3, 0)};
    for (std::size_t i = 0; i < grid.texels.size(); ++i) {
        if (grid.texels[i].part >= 0) std::fill_n(&texture.pixels[3 * i], 3, std::uint8_t{200});
    }
    spread(texture, grid, 5);
    EXPECT_EQ(std::ranges::count(texture.pixels, 200), 3 * 42 * 42);
}

std::vector<Triangle> all_triangles(const Face& face) {
    std::vector<Triangle> all;
    for (const FacePart& part : face.parts)
        all.insert(all.end(), part.triangles.begin(), part.triangles.end());
    return all;
}

TEST(Bake, NothingInTheWayIsOpen) {
    const Face face = mapped_square();
    const TexelGrid grid = lay_out(face, Material::kSkin, 16);
    for (const float open : openness(face, all_triangles(face), grid))
        EXPECT_GT(open, 0.97f);  // grazing ways
}

TEST(Bake, ACoverTakesTheLight) {
    Face face = mapped_square();
    add_square(face, Material::kCloth, 400, 10);
    const TexelGrid grid = lay_out(face, Material::kSkin, 16);
    const std::vector<float> open = openness(face, all_triangles(face), grid);
    EXPECT_LT(open[8 * 16 + 8], 0.15f);
}

TEST(Bake, NoiseIsBoundedAndRepeats) {
    float least = 1, most = 0;
    for (int i = 0; i < 4000; ++i) {
        const Eigen::Vector3f place(0.37f * i, -0.11f * i, 0.05f * i);
        const float value = noise(place);
        EXPECT_EQ(value, noise(place));
        least = std::min(least, value);
        most = std::max(most, value);
    }
    EXPECT_GE(least, 0);
    EXPECT_LE(most, 1);
    EXPECT_GT(most - least, 0.7f);
    for (int i = 0; i < 20; ++i) {  // no jump across the lattice
        const Eigen::Vector3f at(static_cast<float>(i), 0.5f, 0.5f), before(i - 1e-4f, 0.5f, 0.5f);
        EXPECT_NEAR(noise(at), noise(before), 1e-3);
    }
}

// Lips of no size far away, an eye, and teeth: what they need is painted, the same each time.
TEST(Bake, SameFaceSameTextures) {
    Face face;
    testing::add_part(face, Material::kLips, Nodes::Constant(LipGrid::kRows * LipGrid::kColumns, 3, 1000),
                      {});
    add_ball(face, Material::kEye, 15, {0, testing::kMiddleY, testing::kMiddleZ});
    add_square(face, Material::kTeeth, 20);
    face.uvs.middleRows(face.parts[1].first_node, face.parts[1].nodes) =
        (face.rest.middleRows(face.parts[1].first_node, face.parts[1].nodes)
             .leftCols(2)
             .cast<float>()
             .array() /
         100)
            .matrix();
    face.uvs.bottomRows(4) << 0, 0, 1, 0, 1, 1, 0, 1;
    Landmarks landmarks;
    landmarks.fill(Eigen::Vector3d::Zero());
    Face again = face;
    const Face canvas = face;
    bake_surfaces(face, canvas, landmarks);
    bake_surfaces(again, canvas, landmarks);
    for (int m = 0; m < kMaterials; ++m) {
        EXPECT_EQ(face.surfaces[m].base_colour.pixels, again.surfaces[m].base_colour.pixels);
        EXPECT_EQ(face.surfaces[m].occlusion_roughness.pixels, again.surfaces[m].occlusion_roughness.pixels);
    }
    EXPECT_FALSE(face.surfaces[int(Material::kEye)].base_colour.pixels.empty());
    EXPECT_FALSE(face.surfaces[int(Material::kTeeth)].base_colour.pixels.empty());
    EXPECT_TRUE(face.surfaces[int(Material::kSkin)].base_colour.pixels.empty());
}

}  // namespace
}  // namespace viaface
