// What a film is to be: size, frame rate, format, and the rate of the sound that goes in. The limits are the
// ones that help, the OpenAPI description and the errors state. Stamps come from integer frame and sample
// indices: frame n is shown at n * denominator / numerator seconds, sample k is heard at k / sample_rate.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace viaface {

inline constexpr int kSmallestFilmSide = 16, kLargestFilmSide = 4096;  // pixels
inline constexpr int kLowestFrameRate = 15, kHighestFrameRate = 120;   // frames per second
inline constexpr int kLowestSampleRate = 8000, kHighestSampleRate = 192000;

enum class FilmFormat {
    kMp4,  // H.264 4:2:0 BT.709 and AAC 48 kHz; even sizes only
    kMkv,  // lossless: FFV1 RGB [RFC 9043] and PCM at the rate of the input; any size
    kPng,  // a folder of frame_00000.png, ... (lossless, with alpha) and sound.wav; any size
};

struct FrameRate {
    int numerator = 30, denominator = 1;  // frames per second: numerator / denominator
};

struct FilmSpec {
    int width = 512, height = 512;  // pixels
    FrameRate fps;
    FilmFormat format = FilmFormat::kMp4;
    int sample_rate = 16000;  // Hz, of the sound that goes in
};

// "mp4", "mkv" or "png"; else InputError("format").
FilmFormat film_format(std::string_view name);
// By the ending .mp4 or .mkv; a path without an ending is a folder of PNG files; else InputError("output").
FilmFormat film_format_of(const std::filesystem::path& output);

// Whole rates from 15 to 120, and 23.976, 29.97, 59.94 and 119.88 (24, 30, 60, 120 times 1000/1001, met
// within 0.005); else InputError("fps").
FrameRate frame_rate(double fps);

// InputError("size"), ("fps") or ("sample_rate") when out of the limits or impossible in the format.
void validate(const FilmSpec& spec);

// The fewest frames that last as long as the sound.
std::int64_t frames_for(std::int64_t samples, int sample_rate, FrameRate fps);
// The sound that lasts as long as the frames, to the nearest sample.
std::int64_t samples_for(std::int64_t frames, int sample_rate, FrameRate fps);

}  // namespace viaface
