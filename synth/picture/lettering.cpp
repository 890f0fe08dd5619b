#include "synth/picture/lettering.hpp"

#include <algorithm>
#include <cctype>

namespace viaface {
namespace {

constexpr int kColumns = 5, kRows = 7, kAdvance = 6;

// Rows from the top, five dots each.
constexpr const char* kLetters[26] = {
    " ### #   ##   #######   ##   ##   #",  // A
    "#### #   ##   ##### #   ##   ##### ",  // B
    " ### #   ##    #    #    #   # ### ",  // C
    "#### #   ##   ##   ##   ##   ##### ",  // D
    "######    #    #### #    #    #####",  // E
    "######    #    #### #    #    #    ",  // F
    " ### #   ##    # ####   ##   # ####",  // G
    "#   ##   ##   #######   ##   ##   #",  // H
    " ###   #    #    #    #    #   ### ",  // I
    "  ###   #    #    #    # #  #  ##  ",  // J
    "#   ##  # # #  ##   # #  #  # #   #",  // K
    "#    #    #    #    #    #    #####",  // L
    "#   ### ### # ## # ##   ##   ##   #",  // M
    "#   ##   ###  ## # ##  ###   ##   #",  // N
    " ### #   ##   ##   ##   ##   # ### ",  // O
    "#### #   ##   ##### #    #    #    ",  // P
    " ### #   ##   ##   ## # ##  #  ## #",  // Q
    "#### #   ##   ##### # #  #  # #   #",  // R
    " #####    #     ###     #    ##### ",  // S
    "#####  #    #    #    #    #    #  ",  // T
    "#   ##   ##   ##   ##   ##   # ### ",  // U
    "#   ##   ##   ##   ##   # # #   #  ",  // V
    "#   ##   ##   ## # ## # ### ###   #",  // W
    "#   ##   # # #   #   # # #   ##   #",  // X
    "#   ##   # # #   #    #    #    #  ",  // Y
    "#####    #   #   #   #   #    #####",  // Z
};
constexpr const char* kHyphen = "               #####               ";

const char* dots_of(char c) {
    const auto letter = std::toupper(static_cast<unsigned char>(c));
    if (letter >= 'A' && letter <= 'Z') return kLetters[letter - 'A'];
    return c == '-' ? kHyphen : nullptr;
}

void fill(Texture& picture, int left, int top, int side, const Rgb& colour) {
    for (int y = std::max(0, top); y < std::min(picture.height, top + side); ++y) {
        for (int x = std::max(0, left); x < std::min(picture.width, left + side); ++x) {
            std::uint8_t* pixel = &picture.pixels[(std::size_t(y) * picture.width + x) * picture.channels];
            std::copy(colour.begin(), colour.end(), pixel);
        }
    }
}

}  // namespace

int text_width(std::string_view text, int dot) {
    return text.empty() ? 0 : (int(text.size()) * kAdvance - (kAdvance - kColumns)) * dot;
}

void write_text(Texture& picture, std::string_view text, int left, int top, int dot, const Rgb& colour) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char* dots = dots_of(text[i]);
        for (int at = 0; dots != nullptr && at < kColumns * kRows; ++at) {
            if (dots[at] != '#') continue;
            fill(picture, left + (int(i) * kAdvance + at % kColumns) * dot, top + at / kColumns * dot, dot,
                 colour);
        }
    }
}

}  // namespace viaface
