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
