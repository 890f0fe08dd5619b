// A film that is kept in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth/film/film_writer.hpp"

namespace viaface {

// Keeps what a film is given.
class Reel : public FilmWriter {
  public:
    void add_frame(const FrameView& frame) override {
        std::vector<std::uint8_t> pixels;
        for (int row = 0; row < frame.height; ++row) {
            const std::uint8_t* first = frame.top_row + row * frame.stride;
            pixels.insert(pixels.end(), first, first + 4 * frame.width);
        }
        frames.push_back(std::move(pixels));
        sound_before_frame.push_back(sound.size());
    }
    void add_sound(std::span<const std::int16_t> samples) override {
        sound.insert(sound.end(), samples.begin(), samples.end());
    }
    void finish() override { finished = true; }

    std::vector<std::vector<std::uint8_t>> frames;
    std::vector<std::size_t> sound_before_frame;
    std::vector<std::int16_t> sound;
    bool finished = false;
};

}  // namespace viaface
