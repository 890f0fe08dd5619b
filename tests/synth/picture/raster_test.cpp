#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "facemodel/gltf.hpp"
#include "simple_faces.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/picture/raster_textures.hpp"

namespace viaface {
namespace {

using testing::bytes;
using testing::painted_balls;
using testing::two_balls;
using testing::wandering;
using testing::waves;

const View kViews[] = {{.width = 201, .height = 150, .yaw = 20},
                       {.width = 96, .height = 260, .tilt = 15, .background = Rgb{0, 177, 64}},
                       {.width = 333, .height = 333, .roll = 30},
                       {.width = 180, .height = 140, .yaw = 30, .orthographic = true}};

double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += i % 4 == 3 ? 0 : std::pow(double(a[i]) - b[i], 2);
    return 10 * std::log10(255 * 255 / (squares / (0.75 * a.size())));
}

std::vector<std::uint8_t> drawn(const Face& face, const View& view, const Drawing& drawing, int step = 1) {
    return bytes(Portrait(face, view, drawing).draw(wandering(face, step)));
}

TEST(Raster, EveryInstructionSetGivesTheSameBytes) {
    const Face face = painted_balls();
    for (const View& view : kViews) {
        const auto baseline = drawn(face, view, {.widest = Instructions::kBaseline});
        for (const Instructions widest : {Instructions::kAvx2, Instructions::kAvx512})
            EXPECT_EQ(drawn(face, view, {.widest = widest}), baseline);
    }
}

TEST(Raster, DrawsWhatTheReferenceDraws) {
    const Face face = painted_balls();
    for (const View& view : kViews) {
        const auto reference = drawn(face, view, {.renderer = Renderer::kOsmesa});
        EXPECT_GT(psnr(drawn(face, view, {}), reference), 38);
    }
}

TEST(Raster, DrawsTheTalkerAsTheReferenceDoes) {
    const std::filesystem::path path = std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo/face.glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no talker at " << path;
    std::ifstream file(path, std::ios::binary);
    const std::vector<std::uint8_t> glb{std::istreambuf_iterator<char>(file), {}};
    const Face face = read_glb(glb);
    for (const View& view : {View{}, View{.width = 256, .height = 256, .yaw = 40}}) {
        const auto reference = bytes(Portrait(face, view, {.renderer = Renderer::kOsmesa}).draw(face.rest));
        const auto best = bytes(Portrait(face, view).draw(face.rest));
        EXPECT_GT(psnr(best, reference), 38);
        for (const Instructions widest : {Instructions::kBaseline, Instructions::kAvx2})
            EXPECT_EQ(bytes(Portrait(face, view, {.threads = 1, .widest = widest}).draw(face.rest)), best);
    }
}

// What lies behind the camera or far outside is left out; the rest is drawn.
TEST(Raster, PlacesFarOutsideDoNoHarm) {
    const Face face = two_balls();
    Portrait portrait(face, View{.width = 100, .height = 100});
    const auto before = bytes(portrait.draw(face.rest));
    for (const double factor : {1e1, 1e3, 1e12, -1e2, 1e300}) portrait.draw(face.rest * factor);
    EXPECT_EQ(bytes(portrait.draw(face.rest)), before);
}

TEST(RasterTextures, LevelsHalveAndKeepTheMean) {
    const Surface surface{waves(64, 3, 0, 255), {}, {}};
    const RasterTextures textures(pack(surface, Material::kSkin));
    const auto mean = [](const raster::Level& level) {
        double sum = 0;
        for (int y = 1; y <= level.rows; ++y) {
            for (int x = 1; x <= level.columns; ++x) sum += level.border[y * level.stride + 8 * x];
        }
        return sum / (level.rows * level.columns);
    };
    const double whole = mean(textures.levels()[0]);
    for (int i = 1; i < 7; ++i) {
        const raster::Level& level = textures.levels()[i];
        EXPECT_EQ(level.columns, 64 >> i);
        EXPECT_NEAR(mean(level), whole, 0.5 * i);  // each level rounds by at most half a step
    }
    for (int i = 7; i < raster::kLevels; ++i)
        EXPECT_EQ(textures.levels()[i].border, textures.levels()[6].border);
}

TEST(RasterTextures, TheBorderRepeatsSideways) {
    const Surface surface{waves(16, 3, 0, 255), {}, {}};
    const RasterTextures textures(pack(surface, Material::kLips));
    const raster::Level& level = textures.levels()[0];
    for (int y = 0; y < 18; ++y) {
        const std::uint8_t* row = level.border + y * level.stride;
        EXPECT_TRUE(std::equal(row, row + 8, row + 16 * 8)) << y;
        EXPECT_TRUE(std::equal(row + 17 * 8, row + 18 * 8, row + 8)) << y;
    }
}

}  // namespace
}  // namespace viaface
