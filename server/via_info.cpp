#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/via_command.hpp"
#include "server/via_models.hpp"
#include "viapoints/stream_packets.hpp"
#include "viapoints/via_chunks.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

void print_chunks(std::span<const std::uint8_t> bytes, std::size_t head_bytes) {
    ByteReader reader(bytes);
    read_via_header(reader, bytes, ViaKind::kStream);
    std::printf("header         %8zu bytes\n", reader.offset());
    while (reader.offset() < head_bytes) {
        const ViaChunk chunk = read_via_chunk(reader, bytes);
        std::printf("chunk %s     %8zu bytes\n", std::string(chunk.type).c_str(), chunk.content.size() + 12);
    }
}

struct Sizes {
    std::size_t payload = 0, segments = 0, phones = 0;
};

Sizes sizes_of(std::span<const std::uint8_t> bytes, std::size_t head_bytes) {
    Sizes sizes;
    PacketReader reader(bytes, head_bytes);
    while (const auto packet = reader.next()) {
        if (packet->type == PacketType::kSegment) {
            sizes.payload += packet->content.size();
            sizes.segments += packet->size;
        }
        if (packet->type == PacketType::kPhones) sizes.phones += packet->size;
    }
    return sizes;
}

void print_head(const StreamHead& head, Eigen::Index modes) {
    std::printf("talker         %s\n",
                head.talker.empty() ? "none: the basis stands in the stream" : head.talker.c_str());
    std::printf(
        "points         %zu, in %d modes, %d of them the talker's, %d blends of his, %d directions "
        "within them\n",
        head.points.size(), static_cast<int>(modes), static_cast<int>(head.shared_modes.size()),
        static_cast<int>(head.blends.cols()), static_cast<int>(head.directions.count()));
    std::printf("bound          %g mm; step %g mm; %d ticks per s; sync at most every %.3g s\n",
                head.bound_mm, head.step_mm, head.ticks_per_s,
                static_cast<double>(head.longest_segment) / head.ticks_per_s);
}

void print_segments(const DecodedStream& stream) {
    std::printf("%-9s %10s %10s %10s %10s %6s\n", "segment", "byte", "bytes", "begin s", "end s", "via");
    for (std::size_t i = 0; i < stream.segments.size(); ++i) {
        const DecodedSegment& s = stream.segments[i];
        std::printf("%-9zu %10zu %10zu %10.3f %10.3f %6zu\n", i, s.offset, s.size, s.begin_s, s.end_s,
                    stream.track(i).time_s.size());
    }
}

}  // namespace

Command add_via_info(CLI::App& via) {
    struct Options {
        std::string stream, talker, model;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app =
        via.add_subcommand("info", "What a stream of via points holds: sizes, rates, segments, damage.");
    app->add_option("stream", options->stream, "the stream, .via")->required();
    app->add_option(
        "--talker", options->talker,
        std::string("whose stream it is: ") + kStreamTalkerHelp + "; any built-in one when absent");
    app->add_option("--model", options->model, "a stream model's file, beside those of the talkers");
    return [options] {
        const StreamModelsAtHand models(options->talker, options->model);
        const Bytes bytes = read_stream_file(options->stream, models.all());
        const DecodedStream stream = decode_stream(bytes, models.all());
        print_head(stream.head, stream.basis.size());
        print_chunks(bytes, stream.head_bytes);
        const Sizes sizes = sizes_of(bytes, stream.head_bytes);
        const double seconds = stream.end_s() - stream.begin_s();
        std::printf(
            "segments       %8zu bytes, of which payload %zu\nphones         %8zu bytes\nwhole          %8zu "
            "bytes\n",
            sizes.segments, sizes.payload, sizes.phones, bytes.size());
        if (seconds > 0)
            std::printf("%.2f s: payload %.1f bit/s, whole %.1f bit/s\n", seconds,
                        8 * static_cast<double>(sizes.payload) / seconds,
                        8 * static_cast<double>(bytes.size()) / seconds);
        print_segments(stream);
        std::printf("%s",
                    stream.damage.empty() ? "no damage\n" : ("damage:\n" + stream.describe_damage()).c_str());
        return stream.damage.empty() ? 0 : 1;
    };
}

}  // namespace viaface
