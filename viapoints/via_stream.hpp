// Motion as a stream of via points: at most so many mm off at any point of any sample, in few bits; the same
// bytes for a file and for the wire, FORMAT.md (kind 2) byte by byte. [ATR98, "Interpolation of via point
// arrays"] for the motion between them.
//
// Time is cut into segments of at most sync_s, each a minimum-jerk spline at rest at both ends: where the
// face is stillest near the end of that time. A segment is told, checked and drawn by itself; where two meet
// they share position, velocity and acceleration (at rest). Within a segment via times lie on a grid and are
// shared by all components; control values (stream_spline.hpp) are whole numbers of steps, predicted and
// range-coded (stream_statistics.hpp), found by search under the bound (stream_search.hpp).
//
// The encoder decodes what it has written, as a receiver does, and measures every sample before it gives the
// bytes away.
#pragma once

#include <functional>

#include "viapoints/phones.hpp"
#include "viapoints/stream_packets.hpp"
#include "viapoints/stream_search.hpp"
#include "viapoints/track.hpp"
#include "viapoints/via_stream_head.hpp"

namespace viaface {

struct StreamOptions {
    double max_error_mm = 1;                       // 0.01 to 100
    double sync_s = 10;                            // 0.2 to 60: sync points are at most so far apart
    int rounds = 2;                                // of the search: more is slower and smaller
    std::function<void()> before_segment = [] {};  // what it throws ends the encoding
};

struct StreamPhone {
    PhoneId phone = kPause;
    double begin_s = 0, end_s = 0;
};

struct StreamAccount {
    std::size_t via_points = 0, segments = 0;
    double seconds = 0;
    std::size_t payload_bytes = 0;  // range-coded via points
    std::size_t head_bytes = 0;     // header and head; basis_bytes of them tell modes or a mean
    std::size_t basis_bytes = 0;
    std::size_t phone_bytes = 0;  // packets of phones
    std::size_t all_bytes = 0;
    double max_error_mm = 0, rms_error_mm = 0;  // of the decoded motion at the samples given
};

struct EncodedStream {
    Bytes bytes;
    StreamAccount account;
};

// `model` may be null: then the basis is the motion's own and stands in the stream. InputError for fewer than
// two samples, times that do not rise, points with gaps, points that the model lacks, options out of range,
// and a bound that cannot be held.
EncodedStream encode_stream(const Motion& motion, const StreamModel* model, const StreamOptions& options = {},
                            const std::vector<StreamPhone>& phones = {});

struct DecodedSegment {
    std::uint32_t first_tick = 0;
    double begin_s = 0, end_s = 0;
    QuantisedSegment via;
    double step_mm = 0;
    std::size_t offset = 0, size = 0;  // of its packet
};

// Bytes that told nothing, and the time that went with them.
struct StreamDamage {
    std::size_t segment = 0;  // index of the segment that it stands before or in place of
    std::size_t offset = 0, size = 0;
    double from_s = 0, to_s = 0;  // to_s infinite when nothing tells the end
    std::string what;
};

struct DecodedStream {
    StreamHead head;
    ConfigurationBasis basis;
    std::vector<DecodedSegment> segments;  // by time
    std::vector<StreamPhone> phones;
    std::vector<StreamDamage> damage;
    std::size_t head_bytes = 0;

    double begin_s() const;
    double end_s() const;
    // Positions [times x 114], mm; NaN where a point is not told, and outside of what was decoded.
    RowMatrix positions(const std::vector<double>& times_s) const;
    // A segment's via points as components of the basis; its spline is at rest at an end that does not move.
    ViaPointTrack track(std::size_t segment) const;
    std::string describe_damage() const;  // one line each
};

// Damage to the head throws (see read_stream_head); all other damage is listed.
DecodedStream decode_stream(std::span<const std::uint8_t> bytes, std::span<const StreamModel* const> models);

// The same, packet by packet.
class StreamDecoder {
  public:
    StreamDecoder(StreamTools tools, std::size_t head_bytes);

    void take(const StreamPacket& packet);
    void lose(std::size_t offset, std::size_t size, std::string what);  // bytes that were no packet
    void finish(std::size_t offset);                                    // there is nothing more

    const DecodedStream& decoded() const { return decoded_; }
    bool ended() const { return ended_; }

  private:
    double told_to_s() const;
    void close_damage(double to_s);
    void take_segment(const StreamPacket& packet);

    StreamTools tools_;
    DecodedStream decoded_;
    std::size_t open_ = 0;  // damage from here on has no end yet
    bool ended_ = false;
};

}  // namespace viaface
