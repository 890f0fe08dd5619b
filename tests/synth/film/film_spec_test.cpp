#include "synth/film/film_spec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace viaface {
namespace {

template <class Call>
std::string refused_field(Call call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.field();
    }
    return "none";
}

FilmSpec sized(int width, int height, FilmFormat format = FilmFormat::kMp4) {
    return {width, height, {30, 1}, format, 16000};
}

TEST(FilmSpec, SizesOutOfTheLimitsAreRefused) {
    for (const auto& [width, height] :
         {std::pair{0, 0}, {15, 512}, {512, 4097}, {100000, 100000}, {-512, 512}}) {
        for (const FilmFormat format : {FilmFormat::kMp4, FilmFormat::kMkv, FilmFormat::kPng}) {
            EXPECT_EQ(refused_field([&] { validate(sized(width, height, format)); }), "size");
        }
    }
    EXPECT_EQ(refused_field([] { validate(sized(16, 4096)); }), "none");
}

TEST(FilmSpec, OddSizesAreForTheLosslessFormats) {
    EXPECT_EQ(refused_field([] { validate(sized(513, 512)); }), "size");
    EXPECT_EQ(refused_field([] { validate(sized(512, 511)); }), "size");
    EXPECT_EQ(refused_field([] { validate(sized(513, 511, FilmFormat::kMkv)); }), "none");
    EXPECT_EQ(refused_field([] { validate(sized(513, 511, FilmFormat::kPng)); }), "none");
}

TEST(FilmSpec, FrameRatesAreWholeOrNtsc) {
    EXPECT_EQ(frame_rate(15).numerator, 15);
    EXPECT_EQ(frame_rate(120).numerator, 120);
    EXPECT_EQ(frame_rate(29.97).numerator, 30000);
    EXPECT_EQ(frame_rate(29.97).denominator, 1001);
    EXPECT_EQ(frame_rate(23.976).numerator, 24000);
    EXPECT_EQ(frame_rate(59.94).numerator, 60000);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double fps : {0.0, 14.0, 121.0, -30.0, 25.5, 1e300, std::nan(""), infinity, -infinity}) {
        EXPECT_EQ(refused_field([&] { frame_rate(fps); }), "fps") << fps;
    }
    for (const FrameRate fps : {FrameRate{0, 1}, {30, 0}, {30, -1}, {60, 2}, {121, 1}, {25000, 1001}}) {
        FilmSpec spec;
        spec.fps = fps;
        EXPECT_EQ(refused_field([&] { validate(spec); }), "fps") << fps.numerator << "/" << fps.denominator;
    }
}

TEST(FilmSpec, FormatsByNameAndByEnding) {
    EXPECT_EQ(film_format("mkv"), FilmFormat::kMkv);
    EXPECT_EQ(film_format_of("a/b.mp4"), FilmFormat::kMp4);
    EXPECT_EQ(film_format_of("a/frames"), FilmFormat::kPng);
    EXPECT_EQ(refused_field([] { film_format("avi"); }), "format");
    EXPECT_EQ(refused_field([] { film_format(""); }), "format");
    EXPECT_EQ(refused_field([] { film_format_of("x.gif"); }), "output");
    EXPECT_EQ(refused_field([] { film_format_of(""); }), "output");
}

TEST(FilmSpec, SampleRatesOutOfTheLimitsAreRefused) {
    for (const int rate : {0, -16000, 7999, 192001}) {
        FilmSpec spec;
        spec.sample_rate = rate;
        EXPECT_EQ(refused_field([&] { validate(spec); }), "sample_rate") << rate;
    }
}

// The fewest frames that cover the sound: one fewer would not.
TEST(FilmSpec, FramesCoverTheSound) {
    for (const FrameRate fps : {FrameRate{30, 1}, {30000, 1001}, {24, 1}, {120, 1}}) {
        for (std::int64_t samples = 0; samples < 20000; samples += 7) {
            const std::int64_t frames = frames_for(samples, 16000, fps);
            const auto lasts = [&](std::int64_t n) { return n * 16000 * fps.denominator; };
            EXPECT_GE(lasts(frames), samples * fps.numerator);
            EXPECT_TRUE(frames == 0 || lasts(frames - 1) < samples * fps.numerator) << samples;
        }
    }
    EXPECT_EQ(samples_for(30, 16000, {30, 1}), 16000);
    EXPECT_EQ(samples_for(1, 48000, {30000, 1001}), 1602);  // 1601.6
}

}  // namespace
}  // namespace viaface
