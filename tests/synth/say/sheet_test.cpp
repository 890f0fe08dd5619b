#include "synth/say/sheet.hpp"

#include <gtest/gtest.h>

#include <set>

#include "synth/picture/lettering.hpp"

namespace viaface {
namespace {

int inked(const Texture& picture) {
    int count = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 3) count += picture.pixels[i] == 255;
    return count;
}

Texture written(std::string_view text, int left, int dot) {
    Texture picture{60, 20, 3, std::vector<std::uint8_t>(60 * 20 * 3)};
    write_text(picture, text, left, 2, dot, {255, 255, 255});
    return picture;
}

TEST(Lettering, EveryLetterIsAnother) {
    std::set<std::vector<std::uint8_t>> shapes;
    for (char c = 'a'; c <= 'z'; ++c) {
        const Texture picture = written(std::string(1, c), 3, 1);
        EXPECT_GT(inked(picture), 6) << c;
        EXPECT_EQ(picture.pixels, written(std::string(1, char(c - 'a' + 'A')), 3, 1).pixels);
        shapes.insert(picture.pixels);
    }
    EXPECT_EQ(shapes.size(), 26u);
}

TEST(Lettering, ADotHasItsSizeAndWhatLiesOutsideIsLeftOut) {
    EXPECT_EQ(inked(written("ab", 2, 2)), 4 * inked(written("ab", 2, 1)));
    EXPECT_EQ(text_width("ab", 2), 22);
    EXPECT_EQ(inked(written("a", -40, 1)), 0);
    EXPECT_EQ(inked(written("?", 2, 1)), 0);
    EXPECT_LT(inked(written("h", 58, 1)), inked(written("h", 2, 1)));
}

// Fourteen stills, each another picture.
TEST(ContactSheet, ShowsEveryStillOnce) {
    const Talker talker = load_talker(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo");
    const Texture sheet = contact_sheet(talker);
    ASSERT_EQ(sheet.width % 7, 0);
    const int side = sheet.width / 7, tile = sheet.height / 2;
    std::set<std::vector<std::uint8_t>> stills;
    for (int i = 0; i < 14; ++i) {
        std::vector<std::uint8_t> still;
        for (int row = 0; row < side; ++row) {
            const auto from = sheet.pixels.begin() +
                              ((i / 7 * tile + row) * sheet.width + i % 7 * side) * std::ptrdiff_t{3};
            still.insert(still.end(), from, from + side * std::ptrdiff_t{3});
        }
        stills.insert(still);
    }
    EXPECT_EQ(stills.size(), 14u);
}

}  // namespace
}  // namespace viaface
