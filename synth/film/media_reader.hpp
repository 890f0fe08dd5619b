// Reads a film, a video or a sound file that anybody may have made: pictures one at a time, sound as one mono
// track, both on the file's own time axis, from which the container's edit list has been applied and encoder
// priming cut. Pictures are upright as their rotation tag says, in quarter turns. Decoders run with one
// thread, so that one file always reads the same.
//
// InputError("media", ...) when the bytes are no such file, are damaged, or exceed the limits below.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "synth/film/frame.hpp"

namespace viaface {

inline constexpr int kLargestMediaSide = 8192;      // pixels
inline constexpr double kLongestMediaSound = 1800;  // s
inline constexpr double kLongestMediaGap = 60;      // s, without sound between two pieces of it

// A file, or bytes that outlive whoever reads them.
using MediaSource = std::variant<std::filesystem::path, std::span<const std::uint8_t>>;

struct TimedFrame {
    Frame frame;        // alpha is 255 where the video has none
    double time_s = 0;  // when it is shown: a whole number of the stream's ticks, rounded once
};

// The pictures in order of presentation. One thread at a time.
class FrameReader {
  public:
    explicit FrameReader(const MediaSource& source);  // InputError("media") when there is no picture
    ~FrameReader();

    int width() const;            // pixels
    int height() const;           // pixels
    double frames_per_s() const;  // as the file says, 0 when it does not
    std::optional<TimedFrame> next();

  private:
    class Decoding;
    std::unique_ptr<Decoding> decoding_;
};

struct MonoSound {
    int rate = 0;  // Hz; 0 when the file has no sound
    std::vector<std::int16_t> samples;
};

// Mono at the file's own rate: 16-bit samples of one channel stay as they are.
MonoSound read_sound(const MediaSource& source);

// Mono at `rate` Hz; sample k is heard at k / rate. Sound before time 0 is cut; gaps are silent; channels are
// mixed. Empty when the file has no sound.
std::vector<std::int16_t> read_sound(const MediaSource& source, int rate);

}  // namespace viaface
