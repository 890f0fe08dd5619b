// Any bytes are a stream (perhaps a damaged one), a stream model, or an error; whole or piece by piece they
// tell the same (but for packets in packets). The first byte says what the others are: a whole file, packets
// behind a good head, the content of a segment (checksums would stop most guesses), or a model.
#include <cstdlib>

#include "viapoints/stream_packets.hpp"
#include "viapoints/stream_segment.hpp"
#include "viapoints/via_stream_head.hpp"
#include "viapoints/via_stream_live.hpp"

namespace viaface {
namespace {

StreamTools good_tools() {
    StreamTools tools;
    tools.head.points = {2, 8};
    tools.basis = {Configuration::Constant(std::nan("")), Eigen::MatrixXd::Zero(kCoordinates, 2)};
    for (const int p : tools.head.points) tools.basis.mean.segment<3>(3 * p) << 1, -2, 0.5;
    tools.basis.modes(3 * 8 + 1, 0) = 1;
    tools.basis.modes(3 * 2, 1) = -1;
    tools.statistics = plain_statistics(2);
    return tools;
}

Bytes joined(Bytes bytes, std::span<const std::uint8_t> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return bytes;
}

// Read whole, such a packet hides those in its content. Piece by piece they come first: a reader that waited
// for what a broken length announces would lose all that follows.
bool holds_packets_in_packets(std::span<const std::uint8_t> bytes) {
    PacketReader packets(bytes, read_stream_head(bytes, {}).size, false);
    while (const auto packet = packets.next()) {
        if (PacketReader(packet->content, 0, false).next()) return true;
    }
    return false;
}

void decode_both_ways(std::span<const std::uint8_t> bytes) {
    std::size_t segments = 0;
    try {
        const DecodedStream stream = decode_stream(bytes, {});
        segments = stream.segments.size();
        if (segments > 0) stream.positions({stream.begin_s(), stream.end_s()});
        stream.describe_damage();
        if (holds_packets_in_packets(bytes)) return;
    } catch (const std::runtime_error&) {
        return;
    }
    LiveStreamDecoder live({}, 1);
    for (std::size_t at = 0; at < bytes.size(); at += 7)
        live.feed(bytes.subspan(at, std::min<std::size_t>(7, bytes.size() - at)));
    live.finish();
    if (live.decoded()->segments.size() != segments) std::abort();
}

}  // namespace
}  // namespace viaface

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    if (size == 0 || size > 4096) return 0;
    const std::span<const std::uint8_t> rest(data + 1, size - 1);
    static const StreamTools tools = good_tools();
    switch (data[0] % 4) {
        case 0:
            decode_both_ways(rest);
            break;
        case 1:
            decode_both_ways(joined(write_stream_head(tools), rest));
            break;
        case 2:
            decode_both_ways(joined(write_stream_head(tools), write_packet(PacketType::kSegment, 3, rest)));
            break;
        default:
            try {
                const Bytes written = write_stream_model(read_stream_model(rest));
                if (write_stream_model(read_stream_model(written)) != written) std::abort();
            } catch (const std::runtime_error&) {
            }
    }
    return 0;
}
