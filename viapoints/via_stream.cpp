#include "viapoints/via_stream.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_choice.hpp"
#include "viapoints/stream_packets.hpp"
#include "viapoints/stream_segment.hpp"
#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kTicksPerSecond = 30;
constexpr int kMostTicksPerSecond = 240;
constexpr std::size_t kMostSamples = 10'000'000;

void check(const Motion& motion, const StreamOptions& options) {
    const auto in = [](const char* field, double value, double low, double high, const char* allowed) {
        if (!(value >= low && value <= high)) throw InputError(field, std::to_string(value), allowed);
    };
    in("max_error_mm", options.max_error_mm, 0.01, 100, "0.01 to 100");
    in("sync_s", options.sync_s, 0.2, 60, "0.2 to 60");
    if (motion.size() < 2 || motion.size() > kMostSamples)
        throw InputError("motion", std::to_string(motion.size()) + " samples", "2 to 10000000 samples");
    if (motion.positions.rows() != static_cast<Index>(motion.size()))
        throw std::invalid_argument("a motion's times and positions differ in number");
    for (std::size_t i = 0; i < motion.size(); ++i) {
        if (!std::isfinite(motion.time_s[i]) || (i > 0 && motion.time_s[i] <= motion.time_s[i - 1]))
            throw InputError("motion", "time " + std::to_string(i), "rising, finite times");
    }
    if (motion.time_s.back() - motion.time_s.front() > 1e6)
        throw InputError("motion", std::to_string(motion.time_s.back() - motion.time_s.front()) + " s",
                         "at most 1000000 s");
}

std::vector<SegmentVia> segments_of(const Motion& motion, const StreamTools& tools,
                                    const std::vector<CutSegment>& cuts, const StreamOptions& options) {
    SegmentEncoder encoder(tools, {.rounds = options.rounds});
    std::vector<SegmentVia> segments;
    for (const CutSegment& cut : cuts) {
        options.before_segment();
        segments.push_back(encoder.encode(motion, cut));
    }
    return segments;
}

std::uint32_t to_ticks(double seconds, const StreamHead& head, double limit) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor((seconds - head.start_s) * head.ticks_per_s), 0.0, limit));
}

// Phones that begin within a segment travel beside it.
Bytes phones_content(const std::vector<StreamPhone>& phones, const StreamHead& head, std::uint32_t first,
                     std::uint32_t last, bool is_last) {
    ByteWriter writer;
    double at = head.start_s + double(first) / head.ticks_per_s;
    for (const StreamPhone& phone : phones) {
        const std::uint32_t tick = to_ticks(phone.begin_s, head, 4e9);
        if ((tick < first && first > 0) || (tick >= last && !is_last)) continue;
        writer.put(phone.phone);
        put_varint(writer, static_cast<std::uint32_t>(std::lround(std::max(0.0, phone.begin_s - at) * 1000)));
        put_varint(writer, static_cast<std::uint32_t>(std::lround((phone.end_s - phone.begin_s) * 1000)));
        at = phone.begin_s;
    }
    return writer.bytes();
}

void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

// As a receiver sees it: from the bytes alone.
void measure(EncodedStream& encoded, const Motion& motion, const StreamModel* model, const StreamHead& head) {
    const std::vector<const StreamModel*> models =
        model ? std::vector<const StreamModel*>{model} : std::vector<const StreamModel*>{};
    const DecodedStream decoded = decode_stream(encoded.bytes, models);
    if (!decoded.damage.empty())
        throw std::runtime_error("the stream does not decode: " + decoded.describe_damage());
    const RowMatrix off = coordinates_of(decoded.positions(motion.time_s) - motion.positions, head.points);
    if (!off.allFinite()) throw std::runtime_error("the stream does not cover the motion");
    encoded.account.max_error_mm = longest_triple(off);
    encoded.account.rms_error_mm = std::sqrt(off.squaredNorm() * 3 / static_cast<double>(off.size()));
}

// The header and the chunk HEAD.
std::size_t bytes_without_basis(const Bytes& head) {
    ByteReader reader(head);
    read_via_header(reader, head, ViaKind::kStream);
    read_via_chunk(reader, head);
    return reader.offset();
}

EncodedStream written(const Motion& motion, const StreamTools& tools, const std::vector<CutSegment>& cuts,
                      const std::vector<SegmentVia>& segments, const std::vector<StreamPhone>& phones) {
    EncodedStream encoded;
    StreamAccount& account = encoded.account;
    encoded.bytes = write_stream_head(tools);
    account.head_bytes = encoded.bytes.size();
    account.basis_bytes = account.head_bytes - bytes_without_basis(encoded.bytes);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const bool is_last = i + 1 == segments.size();
        const Bytes spoken =
            phones_content(phones, tools.head, cuts[i].first_tick, cuts[i].last_tick, is_last);
        if (!spoken.empty()) {
            const Bytes packet = write_packet(PacketType::kPhones, cuts[i].first_tick, spoken);
            account.phone_bytes += packet.size();
            append(encoded.bytes, packet);
        }
        const Bytes content = segment_content(tools, segments[i]);
        account.payload_bytes += content.size();
        account.via_points += segments[i].via.tick.size();
        append(encoded.bytes, write_packet(PacketType::kSegment, cuts[i].first_tick, content));
    }
    append(encoded.bytes, write_packet(PacketType::kEnd, cuts.back().last_tick, {}));
    account.segments = segments.size();
    account.seconds = motion.time_s.back() - motion.time_s.front();
    account.all_bytes = encoded.bytes.size();
    return encoded;
}

}  // namespace

EncodedStream encode_stream(const Motion& motion, const StreamModel* model, const StreamOptions& options,
                            const std::vector<StreamPhone>& phones) {
    check(motion, options);
    for (int ticks_per_s = kTicksPerSecond;; ticks_per_s *= 2) {
        const auto [tools, holds] =
            chosen_tools(motion, model, options.max_error_mm, options.sync_s, ticks_per_s);
        if (!holds && ticks_per_s == kTicksPerSecond) continue;
        const std::vector<CutSegment> cuts = cut_motion(motion, tools.head);
        std::vector<SegmentVia> segments;
        try {
            segments = segments_of(motion, tools, cuts, options);
        } catch (const InputError&) {
            if (ticks_per_s == kMostTicksPerSecond) throw;
            continue;
        }
        EncodedStream encoded = written(motion, tools, cuts, segments, phones);
        measure(encoded, motion, model, tools.head);
        if (encoded.account.max_error_mm > options.max_error_mm)
            throw std::runtime_error("the stream exceeds its bound");
        return encoded;
    }
}

}  // namespace viaface
