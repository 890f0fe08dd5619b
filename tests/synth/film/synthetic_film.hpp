// A picture that moves and a sound that is known at every instant.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "synth/film/film_writer.hpp"
#include "tests/scratch_folder.hpp"

namespace viaface::test {

// Smooth shades that drift by a pixel and a half a frame, with a bright disc that circles: every channel
// moves.
inline Frame moving_picture(int width, int height, std::int64_t n) {
    Frame frame{width, height, {}};
    const double turn = 0.15 * static_cast<double>(n), drift = 1.5 * static_cast<double>(n);
    const double cx = width * (0.5 + 0.3 * std::cos(turn)), cy = height * (0.5 + 0.3 * std::sin(turn));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double disc = 1 / (1 + std::exp(std::hypot(x - cx, y - cy) - 0.15 * height));
            const double wave = 0.5 + 0.4 * std::sin(2 * std::numbers::pi * (x + drift) / width);
            for (const double shade : {wave + 0.1 * disc, 0.3 + 0.5 * disc, 0.8 * y / height + 0.1}) {
                frame.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * shade)));
            }
            frame.rgba.push_back(255);
        }
    }
    return frame;
}

// A sweep from 200 Hz to 5 kHz in two seconds that starts at its full loudness at t = 0, -1 to 1.
inline double sweep(double t) {
    return t < 0 ? 0 : 0.5 * std::cos(2 * std::numbers::pi * (200 * t + 1200 * t * t));
}

inline std::vector<std::int16_t> sweep_samples(std::int64_t count, int rate) {
    std::vector<std::int16_t> samples;
    for (std::int64_t k = 0; k < count; ++k) {
        samples.push_back(
            static_cast<std::int16_t>(std::lround(32767 * sweep(static_cast<double>(k) / rate))));
    }
    return samples;
}

struct Clip {
    FilmSpec spec{128, 96, {30, 1}, FilmFormat::kMp4, 16000};
    std::int64_t frames = 45, samples = 24000;
    int piece = 4000;  // samples handed over at a time
};

// Hands over the sound a little ahead of the pictures, as a talker does.
inline void write_clip(FilmWriter& film, const Clip& clip) {
    const auto sound = sweep_samples(clip.samples, clip.spec.sample_rate);
    std::size_t given = 0;
    for (std::int64_t n = 0; n < clip.frames; ++n) {
        const auto ahead =
            static_cast<std::size_t>(samples_for(n, clip.spec.sample_rate, clip.spec.fps) + 2000);
        while (given < sound.size() && given < ahead) {
            const auto count = std::min<std::size_t>(clip.piece, sound.size() - given);
            film.add_sound(std::span(sound).subspan(given, count));
            given += count;
        }
        film.add_frame(view(moving_picture(clip.spec.width, clip.spec.height, n)));
    }
    film.add_sound(std::span(sound).subspan(given));
    film.finish();
}

inline Bytes streamed(const Clip& clip) {
    Bytes bytes;
    const auto film = open_film(clip.spec, [&](std::span<const std::uint8_t> more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
        return true;
    });
    write_clip(*film, clip);
    return bytes;
}

}  // namespace viaface::test
