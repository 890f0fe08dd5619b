#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "viapoints/stream_packets.hpp"
#include "viapoints/stream_segment.hpp"
#include "viapoints/stream_spline.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {

namespace {

using Eigen::Index;

double seconds_at(const StreamHead& head, std::uint32_t tick) {
    return head.start_s + double(tick) / head.ticks_per_s;
}

std::vector<StreamPhone> phones_in(const StreamPacket& packet, const StreamHead& head) {
    std::vector<StreamPhone> phones;
    ByteReader reader(packet.content);
    double at = seconds_at(head, packet.tick);
    while (reader.left() > 0) {
        StreamPhone phone;
        phone.phone = reader.get<std::uint8_t>();
        if (phone.phone >= phone_table().size()) throw std::runtime_error("a phone that is not known");
        at += take_varint(reader) / 1000.0;
        phone.begin_s = at;
        phone.end_s = at + take_varint(reader) / 1000.0;
        phones.push_back(phone);
    }
    return phones;
}

}  // namespace

StreamDecoder::StreamDecoder(StreamTools tools, std::size_t head_bytes) : tools_(std::move(tools)) {
    decoded_.head = tools_.head;
    decoded_.basis = tools_.basis;
    decoded_.head_bytes = head_bytes;
}

double StreamDecoder::told_to_s() const {
    return decoded_.segments.empty() ? tools_.head.start_s : decoded_.segments.back().end_s;
}

// Damage stands between the segment before and the one now taken, if it hides any time.
void StreamDecoder::close_damage(double to_s) {
    for (std::size_t i = open_; i < decoded_.damage.size(); ++i) decoded_.damage[i].to_s = to_s;
    open_ = decoded_.damage.size();
}

void StreamDecoder::lose(std::size_t offset, std::size_t size, std::string what) {
    const double inf = std::numeric_limits<double>::infinity();
    decoded_.damage.push_back({decoded_.segments.size(), offset, size, told_to_s(), inf, std::move(what)});
}

void StreamDecoder::take_segment(const StreamPacket& packet) {
    DecodedSegment segment;
    segment.first_tick = packet.tick;
    segment.offset = packet.offset;
    segment.size = packet.size;
    SegmentVia via = segment_in(tools_, packet.content);
    segment.step_mm = step_of(tools_.head, via.finer);
    segment.via = std::move(via.via);
    segment.begin_s = seconds_at(tools_.head, packet.tick);
    segment.end_s = seconds_at(tools_.head, packet.tick + static_cast<std::uint32_t>(segment.via.length()));
    const double told = told_to_s();
    if (segment.begin_s < told)
        throw std::runtime_error("a segment that begins before the one before it ends");
    if (segment.begin_s > told && open_ == decoded_.damage.size())
        lose(packet.offset, 0, "a segment is missing");
    close_damage(segment.begin_s);
    decoded_.segments.push_back(std::move(segment));
}

void StreamDecoder::take(const StreamPacket& packet) {
    if (ended_) return lose(packet.offset, packet.size, "bytes after the end");
    try {
        if (packet.type == PacketType::kSegment) take_segment(packet);
        if (packet.type == PacketType::kPhones) {
            const auto phones = phones_in(packet, tools_.head);
            decoded_.phones.insert(decoded_.phones.end(), phones.begin(), phones.end());
        }
        if (packet.type == PacketType::kEnd) {
            const double end = seconds_at(tools_.head, packet.tick);
            if (end > told_to_s() && open_ == decoded_.damage.size())
                lose(packet.offset, 0, "a segment is missing");
            close_damage(std::max(end, told_to_s()));
            ended_ = true;
        }
    } catch (const std::runtime_error& error) {
        lose(packet.offset, packet.size, error.what());
    }
}

void StreamDecoder::finish(std::size_t offset) {
    if (!ended_) lose(offset, 0, "cut short: the end is missing");
}

DecodedStream decode_stream(std::span<const std::uint8_t> bytes, std::span<const StreamModel* const> models) {
    ReadHead head = read_stream_head(bytes, models);
    PacketReader reader(bytes, head.size);
    StreamDecoder decoder(std::move(head.tools), head.size);
    std::size_t seen = 0;
    const auto lose_damage = [&] {
        for (; seen < reader.damage().size(); ++seen)
            decoder.lose(reader.damage()[seen].offset, reader.damage()[seen].size,
                         reader.damage()[seen].what);
    };
    while (const auto packet = reader.next()) {
        lose_damage();
        decoder.take(*packet);
    }
    lose_damage();
    decoder.finish(bytes.size());
    return decoder.decoded();
}

double DecodedStream::begin_s() const { return segments.empty() ? head.start_s : segments.front().begin_s; }
double DecodedStream::end_s() const { return segments.empty() ? head.start_s : segments.back().end_s; }

RowMatrix DecodedStream::positions(const std::vector<double>& times_s) const {
    RowMatrix rows = RowMatrix::Constant(static_cast<Index>(times_s.size()), kCoordinates, std::nan(""));
    const double near = 1e-6 / head.ticks_per_s;
    std::size_t n = 0;
    for (const DecodedSegment& segment : segments) {
        std::vector<double> ticks;
        while (n < times_s.size() && times_s[n] < segment.begin_s - near) ++n;
        const std::size_t first = n;
        for (; n < times_s.size() && times_s[n] <= segment.end_s + near; ++n)
            ticks.push_back(std::clamp((times_s[n] - head.start_s) * head.ticks_per_s - segment.first_tick,
                                       0.0, double(segment.via.length())));
        if (ticks.empty()) continue;
        const RowMatrix points = to_points(basis, components_at(segment.via, segment.step_mm, ticks));
        for (const int p : head.points)
            rows.block(static_cast<Index>(first), 3 * p, points.rows(), 3) = points.middleCols<3>(3 * p);
    }
    return rows;
}

ViaPointTrack DecodedStream::track(std::size_t index) const {
    const DecodedSegment& segment = segments.at(index);
    const auto [first, last] = std::pair(segment.via.tick.begin() + (moves_first(segment.via.tick) ? 2 : 0),
                                         segment.via.tick.end() - (moves_last(segment.via.tick) ? 2 : 0));
    const std::vector<double> ticks(first, last);
    ViaPointTrack track{{}, components_at(segment.via, segment.step_mm, ticks)};
    for (const double tick : ticks) track.time_s.push_back(segment.begin_s + tick / head.ticks_per_s);
    return track;
}

std::string DecodedStream::describe_damage() const {
    std::string lines;
    for (const StreamDamage& d : damage) {
        char line[160];
        std::snprintf(line, sizeof line, "segment %zu, byte %zu, %zu bytes, %.3f s to ", d.segment, d.offset,
                      d.size, d.from_s);
        lines += line + (std::isfinite(d.to_s) ? std::to_string(d.to_s) + " s" : std::string("the end")) +
                 ": " + d.what + "\n";
    }
    return lines;
}

}  // namespace viaface
