#include "synth/film/film_spec.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr const char* kFrameRates = "a whole number from 15 to 120, or 23.976, 29.97, 59.94 or 119.88";
constexpr std::array kNtscRates = {24, 30, 60, 120};  // times 1000/1001

std::string shown(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::string size_text(const FilmSpec& spec) {
    return std::to_string(spec.width) + "x" + std::to_string(spec.height);
}

bool side_fits(int side) { return side >= kSmallestFilmSide && side <= kLargestFilmSide; }

void validate_size(const FilmSpec& spec) {
    const std::string range = std::to_string(kSmallestFilmSide) + " to " + std::to_string(kLargestFilmSide);
    if (!side_fits(spec.width) || !side_fits(spec.height)) {
        throw InputError("size", size_text(spec), "width and height from " + range);
    }
    if (spec.format == FilmFormat::kMp4 && (spec.width % 2 != 0 || spec.height % 2 != 0)) {
        throw InputError("size", size_text(spec), "even width and height from " + range + " (mp4)");
    }
}

bool is_known(FrameRate fps) {
    if (fps.denominator == 1) return fps.numerator >= kLowestFrameRate && fps.numerator <= kHighestFrameRate;
    for (const int rate : kNtscRates) {
        if (fps.denominator == 1001 && fps.numerator == 1000 * rate) return true;
    }
    return false;
}

}  // namespace

FilmFormat film_format(std::string_view name) {
    if (name == "mp4") return FilmFormat::kMp4;
    if (name == "mkv") return FilmFormat::kMkv;
    if (name == "png") return FilmFormat::kPng;
    throw InputError("format", std::string(name), "mp4, mkv or png");
}

FilmFormat film_format_of(const std::filesystem::path& output) {
    const std::string ending = output.extension().string();
    if (ending == ".mp4") return FilmFormat::kMp4;
    if (ending == ".mkv") return FilmFormat::kMkv;
    if (ending.empty() && !output.empty()) return FilmFormat::kPng;
    throw InputError("output", output.string(), "a name ending in .mp4 or .mkv, or a folder for PNG files");
}

FrameRate frame_rate(double fps) {
    constexpr double kNear = 0.005;
    for (const int rate : kNtscRates) {
        if (std::abs(fps - rate * 1000.0 / 1001.0) < kNear) return {1000 * rate, 1001};
    }
    if (fps >= kLowestFrameRate && fps <= kHighestFrameRate && fps == std::floor(fps)) {
        return {static_cast<int>(fps), 1};
    }
    throw InputError("fps", shown(fps), kFrameRates);
}

void validate(const FilmSpec& spec) {
    validate_size(spec);
    if (!is_known(spec.fps)) {
        const auto [numerator, denominator] = spec.fps;
        throw InputError("fps", std::to_string(numerator) + "/" + std::to_string(denominator), kFrameRates);
    }
    if (spec.sample_rate < kLowestSampleRate || spec.sample_rate > kHighestSampleRate) {
        throw InputError("sample_rate", std::to_string(spec.sample_rate),
                         std::to_string(kLowestSampleRate) + " to " + std::to_string(kHighestSampleRate));
    }
}

std::int64_t frames_for(std::int64_t samples, int sample_rate, FrameRate fps) {
    const std::int64_t per_frame = std::int64_t{sample_rate} * fps.denominator;
    return (samples * fps.numerator + per_frame - 1) / per_frame;
}

std::int64_t samples_for(std::int64_t frames, int sample_rate, FrameRate fps) {
    return (frames * sample_rate * fps.denominator + fps.numerator / 2) / fps.numerator;
}

}  // namespace viaface
