#include "synth/speech/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "base/error.hpp"

namespace viaface {
namespace {

struct Spelling {
    char32_t first, last;
    std::string_view text;
};

// The first range that holds a character spells it; what no range holds is looked up in kLatin.
constexpr Spelling kSpellings[] = {
    {0x09, 0x09, " "},
    {0x0a, 0x0a, "\n"},
    {0x0b, 0x0c, "\n\n"},
    {0x0d, 0x0d, "\n"},
    {'*', '*', " "},
    {'[', '[', "("},
    {'\\', '\\', " "},
    {']', ']', ")"},
    {'^', '`', " "},
    {'{', '{', "("},
    {'|', '|', " "},
    {'}', '}', ")"},
    {'~', '~', " "},
    {0x85, 0x85, "\n"},
    {0xa0, 0xa0, " "},
    {0xa2, 0xa2, " cents "},
    {0xa3, 0xa3, " pounds "},
    {0xa5, 0xa5, " yen "},
    {0xa7, 0xa7, " section "},
    {0xa9, 0xa9, " copyright "},
    {0xaa, 0xaa, "a"},
    {0xab, 0xab, "\""},
    {0xac, 0xac, " not "},
    {0xa1, 0xaf, ""},
    {0xb0, 0xb0, " degrees "},
    {0xb1, 0xb1, " plus or minus "},
    {0xb2, 0xb2, " squared "},
    {0xb3, 0xb3, " cubed "},
    {0xb4, 0xb4, "'"},
    {0xb5, 0xb5, " micro "},
    {0xb6, 0xb8, " "},
    {0xb9, 0xb9, "1"},
    {0xba, 0xba, "o"},
    {0xbb, 0xbb, "\""},
    {0xbc, 0xbc, " one quarter "},
    {0xbd, 0xbd, " one half "},
    {0xbe, 0xbe, " three quarters "},
    {0xbf, 0xbf, ""},
    {0xc6, 0xc6, "AE"},
    {0xd0, 0xd0, "D"},
    {0xd7, 0xd7, " times "},
    {0xd8, 0xd8, "O"},
    {0xde, 0xde, "Th"},
    {0xdf, 0xdf, "ss"},
    {0xe6, 0xe6, "ae"},
    {0xf0, 0xf0, "d"},
    {0xf7, 0xf7, " divided by "},
    {0xf8, 0xf8, "o"},
    {0xfe, 0xfe, "th"},
    {0x110, 0x110, "D"},
    {0x111, 0x111, "d"},
    {0x126, 0x126, "H"},
    {0x127, 0x127, "h"},
    {0x131, 0x131, "i"},
    {0x132, 0x132, "IJ"},
    {0x133, 0x133, "ij"},
    {0x138, 0x138, "k"},
    {0x141, 0x141, "L"},
    {0x142, 0x142, "l"},
    {0x149, 0x149, "n"},
    {0x14a, 0x14a, "Ng"},
    {0x14b, 0x14b, "ng"},
    {0x152, 0x152, "OE"},
    {0x153, 0x153, "oe"},
    {0x166, 0x166, "T"},
    {0x167, 0x167, "t"},
    {0x1a0, 0x1a0, "O"},
    {0x1a1, 0x1a1, "o"},
    {0x1af, 0x1af, "U"},
    {0x1b0, 0x1b0, "u"},
    {0x259, 0x259, "e"},
    {0x2b9, 0x2bf, "'"},
    {0x300, 0x36f, ""},
    {0x1e9e, 0x1e9e, "SS"},
    {0x2000, 0x200a, " "},
    {0x200b, 0x200f, ""},
    {0x2010, 0x2011, "-"},
    {0x2012, 0x2013, "\x01"},
    {0x2014, 0x2015, ", "},
    {0x2018, 0x201b, "'"},
    {0x201c, 0x201f, "\""},
    {0x2020, 0x2025, ", "},
    {0x2026, 0x2026, "... "},
    {0x2028, 0x2029, "\n\n"},
    {0x202a, 0x202e, ""},
    {0x202f, 0x202f, " "},
    {0x2030, 0x2030, " per mille "},
    {0x2032, 0x2032, "'"},
    {0x2033, 0x2033, "\""},
    {0x2039, 0x203a, "\""},
    {0x2044, 0x2044, "/"},
    {0x205f, 0x205f, " "},
    {0x2060, 0x206f, ""},
    {0x20ac, 0x20ac, " euros "},
    {0x20d0, 0x20ff, ""},
    {0x2116, 0x2116, " number "},
    {0x2122, 0x2122, ""},
    {0x2190, 0x2211, " "},
    {0x2212, 0x2212, " minus "},
    {0x2213, 0x2bff, " "},
    {0x3000, 0x3000, " "},
    {0xfb00, 0xfb00, "ff"},
    {0xfb01, 0xfb01, "fi"},
    {0xfb02, 0xfb02, "fl"},
    {0xfb03, 0xfb03, "ffi"},
    {0xfb04, 0xfb04, "ffl"},
    {0xfe00, 0xfe0f, ""},
    {0xfeff, 0xfeff, ""},
    {0xfffc, 0xfffd, " "},
    {0x1f000, 0x1faff, " "},
    {0xe0000, 0xe01ef, ""},
};

struct Letters {
    char32_t first;
    std::string_view letters;  // '?' where no single letter stands for the accented one
};

constexpr Letters kLatin[] = {
    {0xc0, "AAAAAA?CEEEEIIII?NOOOOO??UUUUY??aaaaaa?ceeeeiiii?nooooo??uuuuy?y"},
    {0x100,
     "AaAaAaCcCcCcCcDd??EeEeEeEeEeGgGgGgGgHh??IiIiIiIiI?IiJjKk?LlLlLlLl??NnNnNn???OoOoOo??RrRrRrSsSsSsSsTtTt?"
     "?"
     "UuUuUuUuUuUuWwYyYZzZzZzs"},
    {0x1cd, "AaIiOoUuUuUuUuUu"},
    {0x218, "SsTt"},
    {0x1e00,
     "AaBbBbBbCcDdDdDdDdDdEeEeEeEeEeFfGgHhHhHhHhHhIiIiKkKkKkLlLlLlLlMmMmMmNnNnNnNnOoOoOoOoPpPpRrRrRrRrSsSsSsS"
     "sSs"
     "TtTtTtTtUuUuUuUuUuVvVvWwWwWwWwWwXxXxYyZzZzZzhtwyas????"
     "AaAaAaAaAaAaAaAaAaAaAaAaEeEeEeEeEeEeEeEeIiIiOoOoOoOo"
     "OoOoOoOoOoOoOoOoUuUuUuUuUuUuUuYyYyYyYy"},
};

std::optional<std::string_view> spelling(char32_t c) {
    for (const Spelling& known : kSpellings) {
        if (c >= known.first && c <= known.last) return known.text;
    }
    for (const auto& [first, letters] : kLatin) {
        if (c < first || c >= first + letters.size()) continue;
        const std::string_view letter = letters.substr(c - first, 1);
        if (letter != "?") return letter;
    }
    return std::nullopt;
}

struct Decoded {
    char32_t character;
    std::size_t size;  // bytes
};

[[noreturn]] void refuse_byte(std::string_view text, std::size_t at) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::string shown = {'0', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    throw InputError("text", "byte " + std::to_string(at) + " is " + shown,
                     "UTF-8 without control characters");
}

// Shortest forms only, no surrogates, nothing above U+10FFFF [RFC 3629].
Decoded decode(std::string_view text, std::size_t at) {
    const auto lead = static_cast<unsigned char>(text[at]);
    if (lead < 0x80) return {lead, 1};
    const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || at + size > text.size()) refuse_byte(text, at);
    char32_t character = lead & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        const auto next = static_cast<unsigned char>(text[at + i]);
        if ((next & 0xc0) != 0x80) refuse_byte(text, at);
        character = character << 6 | (next & 0x3fu);
    }
    constexpr std::array<char32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = character >= 0xd800 && character <= 0xdfff;
    if (character < kSmallest[size] || surrogate || character > 0x10ffff) refuse_byte(text, at);
    return {character, size};
}

// An en dash (\x01 so far) between digits is "to", any other is a break.
std::string with_dashes(const std::string& text) {
    const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\x01') {
            result += i > 0 && is_digit(i - 1) && is_digit(i + 1) ? " to " : ", ";
        } else {
            result += text[i];
        }
    }
    return result;
}

std::string unix_line_ends(std::string_view text) {
    std::string result(text);
    for (std::size_t at = 0; (at = result.find("\r\n", at)) != std::string::npos;) result.erase(at, 1);
    return result;
}

}  // namespace

std::string plain_text(std::string_view raw) {
    const std::string text = unix_line_ends(raw);
    std::string plain;
    for (std::size_t at = 0; at < text.size();) {
        const auto [character, size] = decode(text, at);
        if (const auto known = spelling(character)) {
            plain += *known;
        } else if (character >= 0x20 && character < 0x7f) {
            plain += static_cast<char>(character);
        } else if (character < 0xa0) {
            refuse_byte(text, at);
        } else {
            throw InputError("text", text.substr(at, size),
                             "English in Latin letters; emoji are passed over");
        }
        at += size;
    }
    return with_dashes(plain);
}

}  // namespace viaface
