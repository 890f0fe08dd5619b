// A container that writes to a file or a sink, the latter from the first packet on, and the order of packets
// in it. For this folder alone.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <optional>

#include "synth/film/film_writer.hpp"
#include "synth/film/libav_handles.hpp"

namespace viaface::libav {

// Packets come in the order of their decoding. What the sink throws is thrown by the call that wrote to it;
// ClientLeft when the sink says so.
class Container {
  public:
    Container(const char* format, Options options, const std::filesystem::path& path);
    Container(const char* format, Options options, FilmSink sink);
    ~Container() { close(); }
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;

    void add_stream(const AVCodecContext& codec);
    void write(AVPacket& packet, int stream);
    void cut();  // ends the fragment: what was written has left when this returns
    void end();

  private:
    Container(const char* format, Options options, const char* url);

    void begin();
    static int write_to_sink(void* self, std::uint8_t* bytes, int size);
    void check_sink() const;
    void check_writing(int code) const;
    int close();

    Handle<AVFormatContext> context_;
    Options options_;
    FilmSink sink_;
    std::vector<AVRational> bases_;
    bool begun_ = false, left_ = false;
    std::exception_ptr sink_error_;
};

// Puts picture and sound packets in the order of their decoding times, and cuts fragments.
class Interleaver {
  public:
    static constexpr int kPicture = 0, kSound = 1;

    // frames_per_fragment: 0 for no fragments.
    Interleaver(Container& container, AVRational picture_base, AVRational sound_base,
                int frames_per_fragment);

    void add(int stream, Handle<AVPacket> packet);
    void end(int stream);

  private:
    void drain();
    void write(int stream);
    void cut();
    bool fragment_is_whole() const;
    int next() const;

    Container& container_;
    std::array<AVRational, 2> bases_;
    int frames_per_fragment_;
    std::array<std::deque<Handle<AVPacket>>, 2> queues_;
    std::array<bool, 2> ended_{};
    std::int64_t sound_end_ = 0;          // in samples, of what is written
    std::optional<std::int64_t> cut_at_;  // in frames
};

}  // namespace viaface::libav
