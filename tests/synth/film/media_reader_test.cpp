#include "synth/film/media_reader.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "tests/synth/film/synthetic_film.hpp"

namespace viaface {
namespace {

using namespace test;

// Reads all there is, or is refused as bad input: nothing else may happen.
void read_rubbish(std::span<const std::uint8_t> bytes) {
    try {
        FrameReader reader{bytes};
        while (reader.next()) {
        }
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "media");
    }
    try {
        read_sound(bytes, 16000);
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "media");
    }
}

TEST(MediaReader, RefusesWhatIsNoMedia) {
    const ScratchFolder folder;
    write_whole(folder / "text.mp4", std::string_view("no film at all, only words\n"));
    write_whole(folder / "empty.mp4", std::string_view());
    for (const char* name : {"text.mp4", "empty.mp4", "missing.mp4", ""}) {
        EXPECT_THROW(FrameReader{folder / name}, InputError) << name;
        EXPECT_THROW(read_sound(folder / name, 16000), InputError) << name;
    }
}

TEST(MediaReader, TellsSizeAndRate) {
    const Bytes film = streamed({.spec = {64, 48, {24, 1}, FilmFormat::kMp4, 16000}, .frames = 36});
    FrameReader reader{std::span(film)};
    EXPECT_EQ(reader.width(), 64);
    EXPECT_EQ(reader.height(), 48);
    EXPECT_NEAR(reader.frames_per_s(), 24, 1e-9);
}

TEST(MediaReader, ReadsAFileAsItReadsItsBytes) {
    const ScratchFolder folder;
    const Bytes film = streamed({});
    write_whole(folder / "film.mp4", film);
    EXPECT_EQ(read_sound(folder / "film.mp4", 22050), read_sound(std::span(film), 22050));
    FrameReader from_file{folder / "film.mp4"}, from_bytes{std::span(film)};
    while (const auto expected = from_bytes.next()) {
        const auto got = from_file.next();
        ASSERT_TRUE(got);
        EXPECT_EQ(got->time_s, expected->time_s);
        EXPECT_EQ(got->frame.rgba, expected->frame.rgba);
    }
    EXPECT_FALSE(from_file.next());
}

// Writes a matrix [a b; c d] into the header of the first track that has a width (ISO 14496-12, 8.3.2).
Bytes tagged(Bytes film, const std::array<int, 4>& matrix) {
    constexpr std::size_t kMatrix = 44, kWidth = 80;  // from the name "tkhd", version 0
    const std::string_view name = "tkhd";
    auto at = std::search(film.begin(), film.end(), name.begin(), name.end());
    while (film.end() - at > 88 && std::all_of(at + kWidth, at + kWidth + 4, [](auto b) { return b == 0; }))
        at = std::search(at + 4, film.end(), name.begin(), name.end());
    if (film.end() - at <= 88) throw std::runtime_error("no track with a width");
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t place = kMatrix + 4 * (i / 2 * 3 + i % 2);
        const auto value = static_cast<std::uint32_t>(matrix[i] * 65536);
        for (std::size_t byte = 0; byte < 4; ++byte)
            at[static_cast<std::ptrdiff_t>(place + byte)] =
                static_cast<std::uint8_t>(value >> (24 - 8 * byte));
    }
    return film;
}

TEST(MediaReader, TurnsPicturesAsTheirTagSays) {
    const Bytes film =
        streamed({.spec = {64, 48, {24, 1}, FilmFormat::kMp4, 16000}, .frames = 3, .samples = 1500});
    const Frame plain = FrameReader{std::span(film)}.next()->frame;
    const auto turned = [&](const std::array<int, 4>& matrix) {
        const Bytes bytes = tagged(film, matrix);
        FrameReader reader{std::span(bytes)};
        Frame frame = reader.next()->frame;
        EXPECT_EQ(reader.width(), frame.width);
        EXPECT_EQ(reader.height(), frame.height);
        return frame;
    };
    const auto pixel = [](const Frame& frame, int x, int y) {
        const auto at = frame.rgba.begin() + 4 * (std::ptrdiff_t{y} * frame.width + x);
        return std::vector<std::uint8_t>(at, at + 4);
    };
    const Frame right = turned({0, 1, -1, 0}), half = turned({-1, 0, 0, -1}), left = turned({0, -1, 1, 0});
    ASSERT_EQ(right.width, 48);
    ASSERT_EQ(half.width, 64);
    ASSERT_EQ(left.height, 64);
    for (const auto& [x, y] : {std::pair(0, 0), {5, 40}, {63, 20}}) {
        EXPECT_EQ(pixel(right, 47 - y, x), pixel(plain, x, y));
        EXPECT_EQ(pixel(half, 63 - x, 47 - y), pixel(plain, x, y));
        EXPECT_EQ(pixel(left, y, 63 - x), pixel(plain, x, y));
    }
    EXPECT_EQ(turned({1, 0, 0, 1}).rgba, plain.rgba);
    const Bytes askew = tagged(film, {1, 1, -1, 1});
    EXPECT_THROW(FrameReader{std::span(askew)}, InputError);
}

TEST(MediaReader, SaysHowFarADamagedFilmGoes) {
    const Bytes film = streamed({.spec = {64, 48, {24, 1}, FilmFormat::kMp4, 16000}, .frames = 40});
    int told = 0;
    for (std::size_t at = film.size() / 2; at + 64 < film.size(); at += film.size() / 20) {
        Bytes damaged = film;
        for (std::size_t i = at; i < at + 64; ++i) damaged[i] ^= 0xff;
        int frames = 0;
        try {
            FrameReader reader{std::span(damaged)};
            while (reader.next()) ++frames;
        } catch (const InputError& error) {
            if (frames == 0) continue;
            const std::string where = "damaged or cut after " + std::to_string(frames) + " frames";
            EXPECT_NE(std::string(error.what()).find(where), std::string::npos) << error.what();
            ++told;
        }
    }
    EXPECT_GT(told, 0);
}

TEST(MediaReader, SaysWhenThereIsNoPicture) {
    const ScratchFolder folder;
    const Clip clip{.spec = {16, 16, {30, 1}, FilmFormat::kPng, 16000}, .frames = 30, .samples = 16000};
    write_clip(*open_film(clip.spec, folder / "film"), clip);
    EXPECT_THROW(FrameReader{folder / "film/sound.wav"}, InputError);
    EXPECT_EQ(read_sound(folder / "film/sound.wav", 16000).size(), 16000u);
    EXPECT_TRUE(read_sound(folder / "film/frame_00000.png", 16000).empty());
}

TEST(MediaReader, SurvivesTruncationAndFlippedBits) {
    const Bytes film =
        streamed({.spec = {64, 48, {30, 1}, FilmFormat::kMp4, 16000}, .frames = 10, .samples = 5000});
    for (std::size_t size = 0; size < film.size(); size += 1 + film.size() / 60) {
        read_rubbish(std::span(film).first(size));
    }
    std::uint32_t seed = 1;
    for (int round = 0; round < 120; ++round) {
        Bytes damaged = film;
        for (int flip = 0; flip < 1 + round % 8; ++flip) {
            seed = seed * 1664525 + 1013904223;
            damaged[seed % damaged.size()] ^= static_cast<std::uint8_t>(1u << (seed >> 28 & 7));
        }
        read_rubbish(damaged);
    }
}

}  // namespace
}  // namespace viaface
