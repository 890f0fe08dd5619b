// One stream of a file, decoded frame by frame with one thread. For this folder alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "synth/film/libav_handles.hpp"
#include "synth/film/media_reader.hpp"

namespace viaface::libav {

// Bytes in memory, read and sought as a file.
struct MemoryFile {
    std::span<const std::uint8_t> bytes;
    std::int64_t at = 0;

    static int read(void* self, std::uint8_t* to, int size);
    static std::int64_t seek(void* self, std::int64_t offset, int whence);
};

// Whatever fails is InputError("media", name of the source, what is allowed).
class StreamDecoder {
  public:
    StreamDecoder(const MediaSource& source, AVMediaType kind);

    bool found() const { return codec_ != nullptr; }  // a stream of that kind
    const AVStream& stream() const { return *format_->streams[index_]; }
    const AVCodecContext& codec() const { return *codec_; }

    const AVFrame* next();  // nullptr after the last

    int accept(int code) const;  // the code when it is no error
    [[noreturn]] void refuse(const char* allowed = "a video or sound file that can be decoded") const;

  private:
    void open(const MediaSource& source);
    void open_codec(const AVCodec* codec);
    void feed();

    std::string name_;
    MemoryFile memory_;
    Handle<AVIOContext> io_;
    Handle<AVFormatContext> format_;
    Handle<AVCodecContext> codec_;
    Handle<AVPacket> packet_{av_packet_alloc()};
    Handle<AVFrame> frame_{av_frame_alloc()};
    int index_ = -1;
    std::int64_t decoded_ = 0;  // frames
};

// A stamp of a stream in seconds, rounded once.
double seconds(std::int64_t stamp, AVRational base);

}  // namespace viaface::libav
