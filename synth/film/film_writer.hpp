// Frames and sound in, a film out: a file, a folder of pictures, or a stream.
//
// Picture and sound start together at 0 and end together: the frames must cover the sound (frames_for() tells
// how many are needed), and sound that ends before them is padded with silence. Add sound ahead of the frames
// it belongs to: a stream sends a frame only once the sound up to its end and some 65 ms beyond is known.
//
// - mp4 file: x264 veryfast at quality 20 with B-frames, a key frame at least every 2 s; AAC at 96 kbit/s, 48
//   kHz, mono; index first. AAC's first packet only primes the decoder: an edit list cuts its 1024 samples.
// - mp4 stream: the same without B-frames and look-ahead, fragmented: the first fragment holds one frame and
//   its sound, later ones at most 100 ms. Players do not heed the edit lists of fragmented files alike (libav
//   plays the priming), so the priming packet is left out: every decoder starts at 0, and the first 21 ms of
//   the sound fade in. Of AAC's last block a decoder may play up to 21 ms of silence beyond the end.
// - mkv: FFV1 plays wherever libav does (ffmpeg, VLC, mpv), not in browsers; the container rounds stamps to
//   1 ms. As a stream it tells neither its length nor where to seek.
//
// Encoders run with one thread each and write neither versions nor times, so that bytes repeat; they do not
// depend on how the sound is cut into pieces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>

#include "synth/film/film_spec.hpp"
#include "synth/film/frame.hpp"

namespace viaface {

// A FilmWriter that has thrown, or is destroyed before finish() returns, leaves nothing behind on disk.
class FilmWriter {
  public:
    virtual ~FilmWriter() = default;
    virtual void add_frame(
        const FrameView& frame) = 0;  // std::invalid_argument when the size is not the film's
    virtual void add_sound(std::span<const std::int16_t> samples) = 0;  // mono, at the film's sample_rate
    virtual void
    finish() = 0;  // std::invalid_argument without a frame, or when frames do not cover the sound
};

// Takes bytes in order; false: whoever listened has left.
using FilmSink = std::function<bool(std::span<const std::uint8_t>)>;

class ClientLeft : public std::runtime_error {
  public:
    ClientLeft() : std::runtime_error("the reader of the film has left") {}
};

// Both encode in a thread of their own (overlapped_writer.hpp), and call the sink there. InputError as
// validate(); for a stream png; for a file an output that cannot be written; for PNG a folder
// that holds files.
std::unique_ptr<FilmWriter> open_film(const FilmSpec& spec, const std::filesystem::path& output);
std::unique_ptr<FilmWriter> open_film(const FilmSpec& spec, FilmSink sink);

}  // namespace viaface
