// A stream as it happens: rows of motion in, packets out as they fall due, and back. The bytes are those of a
// stream with a sync point wherever a packet ends, so that a receiver may come and go.
//
// A packet covers at most the look-ahead: the first row of a packet waits that long, the last one not at all,
// and none longer. Ends rest where the face is nearly still, else they move (stream_spline.hpp): each packet
// tells its own state, so that no error is handed on.
#pragma once

#include <optional>

#include "viapoints/stream_segment.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {

struct LiveOptions {
    double max_error_mm = 1;
    double look_ahead_s = 1;  // 0.1 to 10
    int rounds = 1;           // of the search
};

class LiveStreamEncoder {
  public:
    // For motion of the points that the first row has, from start_s on. The basis is the model's, and cannot
    // grow; of few points of another person, it holds every way that they can go. The first row is to be
    // pushed too.
    LiveStreamEncoder(const StreamModel& model, double start_s, const Configuration& first,
                      const LiveOptions& options);

    LiveStreamEncoder(const LiveStreamEncoder&) = delete;
    LiveStreamEncoder& operator=(const LiveStreamEncoder&) = delete;

    Bytes head() const;  // to be sent first
    // The packets that fall due with this row: none, or one. InputError when the row's time does not rise, a
    // point is missing, or the bound cannot be held.
    Bytes push(double time_s, const Configuration& row);
    Bytes finish();  // what is left, and the end

  private:
    Bytes packet(std::uint32_t last_tick, bool whole);

    LiveOptions options_;
    StreamTools tools_;
    SegmentEncoder encoder_;
    Motion waiting_;  // from the last packet's end on
    std::uint32_t told_ = 0;
};

class LiveStreamDecoder {
  public:
    LiveStreamDecoder(std::vector<const StreamModel*> models, double rate_hz);

    // Rows that can be drawn now and could not before, at whole multiples of 1 / rate_hz from the stream's
    // start; times of damage are left out. Throws as read_stream_head does.
    Motion feed(std::span<const std::uint8_t> bytes);
    Motion finish();  // there is nothing more: std::runtime_error when not even the head came

    const DecodedStream* decoded() const { return decoder_ ? &decoder_->decoded() : nullptr; }

  private:
    bool read_head();
    Motion take(bool more);
    Motion rows();

    std::vector<const StreamModel*> models_;
    double rate_hz_;
    Bytes bytes_;            // not yet taken
    std::size_t taken_ = 0;  // bytes before them
    std::optional<StreamDecoder> decoder_;
    std::size_t segments_ = 0;
    std::int64_t next_row_ = 0;
};

}  // namespace viaface
