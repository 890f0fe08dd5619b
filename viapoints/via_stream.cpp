#include "viapoints/via_stream.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_packets.hpp"
#include "viapoints/stream_segment.hpp"
#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kTicksPerSecond = 30;
constexpr int kMostTicksPerSecond = 240;
constexpr double kStepPerBound = 5;  // where no statistics say otherwise
constexpr double kBitsOfMode = 0.7;  // per second, about
constexpr std::size_t kMostSamples = 10'000'000;

// A bound as a float, and not above it.
double stored_bound(double bound_mm) {
    return static_cast<double>(std::nextafter(static_cast<float>(bound_mm), 0.0f));
}

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

// The basis of a motion of its own: its mean, and as many modes as its extension finds.
ConfigurationBasis mean_of(const RowMatrix& positions) {
    return stored_basis({positions.colwise().mean().transpose(), Eigen::MatrixXd(kCoordinates, 0)});
}

std::uint32_t longest_segment(const StreamOptions& options, int ticks_per_s) {
    return static_cast<std::uint32_t>(std::max(1.0, std::floor(options.sync_s * ticks_per_s + 1e-9)));
}

// In modes of the motion's own alone.
StreamTools own_tools(const Motion& motion, const std::vector<int>& points, double max_error_mm) {
    StreamTools tools;
    tools.head.points = points;
    tools.head.bound_mm = stored_bound(max_error_mm);
    tools.head.step_mm = static_cast<double>(static_cast<float>(kStepPerBound * max_error_mm));
    tools.basis = extended_basis(mean_of(motion.positions), points, motion.positions,
                                 kBasisShare * tools.head.bound_mm);
    return tools;
}

// About what is told of the basis and in it.
double bits_of(const StreamTools& tools, double seconds) {
    return 8 * static_cast<double>(write_stream_head(tools).size()) +
           kBitsOfMode * seconds * static_cast<double>(tools.basis.size());
}

// In modes of the model alone, or in those of its table and blends of the others, whichever costs less, with
// the modes of the motion's own that either needs; where it needs some, in those alone if that costs less.
StreamTools cheapest_tools(const StreamModel& model, const Motion& motion, const std::vector<int>& points,
                           double max_error_mm) {
    const double share = kBasisShare * stored_bound(max_error_mm),
                 seconds = motion.time_s.back() - motion.time_s.front();
    const auto shared = [&](std::vector<int> modes, BlendWeights blends) {
        StreamTools tools = shared_tools(model, points, max_error_mm, std::move(modes), std::move(blends));
        tools.basis = extended_basis(tools.basis, points, motion.positions, share);
        return tools;
    };
    const StreamTools alone = shared(needed_modes(model.basis, points, motion.positions, share), {});
    const int components = model.tables[static_cast<std::size_t>(alone.head.table)].components;
    const std::vector<int> known = independent_modes(model.basis, points, components);
    const StreamTools blended =
        shared(known, needed_blends(model.basis, known, points, motion.positions, share));
    const StreamTools& best = bits_of(blended, seconds) < bits_of(alone, seconds) ? blended : alone;
    const auto of_model = std::ssize(best.head.shared_modes) + best.head.blends.cols();
    if (best.basis.size() == of_model) return best;
    StreamTools own = own_tools(motion, points, max_error_mm);
    return bits_of(own, seconds) < bits_of(best, seconds) ? own : best;
}

StreamTools tools_for(const Motion& motion, const StreamModel* model, const StreamOptions& options,
                      int ticks_per_s) {
    const std::vector<int> points = measured_points(motion.positions, "motion");
    StreamTools tools = model ? cheapest_tools(*model, motion, points, options.max_error_mm)
                              : own_tools(motion, points, options.max_error_mm);
    tools.head.start_s = motion.time_s.front();
    tools.head.ticks_per_s = ticks_per_s;
    tools.head.longest_segment = longest_segment(options, ticks_per_s);
    if (tools.basis.size() == 0)
        tools.basis.modes =
            Eigen::MatrixXd::Identity(kCoordinates, kCoordinates).middleCols(3 * points.front(), 1);
    tools.statistics = with_components(tools.statistics, static_cast<int>(tools.basis.size()));
    return tools;
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

StreamTools shared_tools(const StreamModel& model, std::vector<int> points, double max_error_mm,
                         std::vector<int> modes, BlendWeights blends) {
    const std::vector<int> held = points_of(model.basis);
    for (const int p : points) {
        if (!std::binary_search(held.begin(), held.end(), p))
            throw InputError(
                "talker", model.name,
                "a talker whose stream model holds the point " + std::string(point_name(p)) + ", or none");
    }
    const std::size_t table = model.table_for(max_error_mm);
    const StreamStatistics& statistics = model.tables[table];
    StreamTools tools;
    StreamHead& head = tools.head;
    head.talker = model.name;
    head.model_identity = model.identity();
    head.table = static_cast<int>(table);
    head.shared_modes = std::move(modes);
    head.blends = std::move(blends);
    head.points = std::move(points);
    head.bound_mm = stored_bound(max_error_mm);
    head.step_mm =
        static_cast<double>(static_cast<float>(statistics.step_mm / statistics.bound_mm * max_error_mm));
    tools.basis = shared_basis(model, head);
    tools.statistics = with_components(statistics, head.shared_modes, static_cast<int>(tools.basis.size()));
    return tools;
}

EncodedStream encode_stream(const Motion& motion, const StreamModel* model, const StreamOptions& options,
                            const std::vector<StreamPhone>& phones) {
    check(motion, options);
    for (int ticks_per_s = kTicksPerSecond;; ticks_per_s *= 2) {
        const StreamTools tools = tools_for(motion, model, options, ticks_per_s);
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
