#include "viapoints/via_stream_live.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_choice.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kLongestHead = 1u << 20;
constexpr std::size_t kFewPoints = 16;  // whose ways are no more than a talker has modes, about

void append_row(Motion& motion, double time_s, const Configuration& row) {
    motion.time_s.push_back(time_s);
    motion.positions.conservativeResize(static_cast<Index>(motion.time_s.size()), kCoordinates);
    motion.positions.bottomRows(1) = row.transpose();
}

void drop_rows(Motion& motion, std::size_t count) {
    motion.time_s.erase(motion.time_s.begin(), motion.time_s.begin() + static_cast<std::ptrdiff_t>(count));
    motion.positions = RowMatrix(motion.positions.bottomRows(static_cast<Index>(motion.time_s.size())));
}

// Every coordinate of the points, one after the other, this far from the mean.
RowMatrix every_way(const ConfigurationBasis& basis, const std::vector<int>& points) {
    constexpr double kWay_mm = 30;
    RowMatrix positions = basis.mean.transpose().replicate(3 * std::ssize(points), 1);
    for (Index i = 0; i < positions.rows(); ++i)
        positions(i, 3 * points[static_cast<std::size_t>(i / 3)] + i % 3) += kWay_mm;
    return positions;
}

std::vector<int> first_modes(Index count) {
    std::vector<int> modes(static_cast<std::size_t>(count));
    std::iota(modes.begin(), modes.end(), 0);
    return modes;
}

// The talker's modes. Where the points are too few to tell these apart, and the first row is none of his:
// those that are independent there, and all other ways.
StreamTools live_tools(const StreamModel& model, const Configuration& first, double max_error_mm) {
    const RowMatrix row = first.transpose();
    const std::vector<int> points = measured_points(row, "motion"), all = first_modes(model.basis.size()),
                           independent = independent_modes(model.basis, points, static_cast<int>(all.size()));
    StreamTools tools = shared_tools(model, points, max_error_mm, independent);
    const double share = kBasisShare * tools.head.bound_mm;
    const bool his = extended_basis(tools.basis, points, row, share).size() == tools.basis.size();
    if (his || points.size() > kFewPoints) return shared_tools(model, points, max_error_mm, all);
    tools.basis = extended_basis(tools.basis, points, every_way(tools.basis, points), share);
    tools.statistics = with_components(tools.statistics, static_cast<int>(tools.basis.size()));
    return tools;
}

}  // namespace

LiveStreamEncoder::LiveStreamEncoder(const StreamModel& model, double start_s, const Configuration& first,
                                     const LiveOptions& options)
    : options_(options),
      tools_(live_tools(model, first, options.max_error_mm)),
      encoder_(tools_, {.rounds = options.rounds, .first_rate = kLiveRate, .few_modes = true}) {
    if (!(options.look_ahead_s >= 0.1 && options.look_ahead_s <= 10))
        throw InputError("look_ahead_s", std::to_string(options.look_ahead_s), "0.1 to 10");
    tools_.head.start_s = start_s;
    tools_.head.longest_segment =
        static_cast<std::uint32_t>(options.look_ahead_s * tools_.head.ticks_per_s + 1e-9);
}

Bytes LiveStreamEncoder::head() const { return write_stream_head(tools_); }

Bytes LiveStreamEncoder::push(double time_s, const Configuration& row) {
    const double last =
        waiting_.time_s.empty() ? -std::numeric_limits<double>::infinity() : waiting_.time_s.back();
    if (!std::isfinite(time_s) || time_s <= last ||
        (told_ == 0 && waiting_.time_s.empty() && time_s != tools_.head.start_s))
        throw InputError("time_s", std::to_string(time_s), "times that rise from the start");
    for (const int p : tools_.head.points)
        if (!point_of(row, p).allFinite())
            throw InputError(std::string(point_name(p)), "missing at " + std::to_string(time_s) + " s",
                             "every point that the first row has");
    append_row(waiting_, time_s, row);
    if (tick_of(tools_.head, time_s) < told_ + tools_.head.longest_segment - 1e-6) return {};
    return packet(told_ + tools_.head.longest_segment, false);
}

// From what was told to the stillest moment up to `last_tick`.
Bytes LiveStreamEncoder::packet(std::uint32_t last_tick, bool whole) {
    const CutSegment cut = cut_at(waiting_, tools_.head, 0, told_, last_tick, whole);
    const SegmentVia segment = encoder_.encode(waiting_, cut);
    const Bytes bytes = write_packet(PacketType::kSegment, told_, segment_content(tools_, segment));
    told_ = cut.last_tick;
    std::size_t gone = 0;
    while (gone + 1 < waiting_.size() && tick_of(tools_.head, waiting_.time_s[gone]) < told_ - 1e-6) ++gone;
    drop_rows(waiting_, gone);
    return bytes;
}

Bytes LiveStreamEncoder::finish() {
    Bytes bytes;
    const auto append = [&](const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); };
    while (!waiting_.time_s.empty()) {
        const auto end =
            static_cast<std::uint32_t>(std::ceil(tick_of(tools_.head, waiting_.time_s.back()) - 1e-6));
        if (end <= told_) break;
        const bool whole = end - told_ <= tools_.head.longest_segment;
        append(packet(whole ? end : told_ + tools_.head.longest_segment, whole));
    }
    append(write_packet(PacketType::kEnd, told_, {}));
    return bytes;
}

LiveStreamDecoder::LiveStreamDecoder(std::vector<const StreamModel*> models, double rate_hz)
    : models_(std::move(models)), rate_hz_(rate_hz) {
    if (!(rate_hz >= 1 && rate_hz <= 1000)) throw InputError("rate", std::to_string(rate_hz), "1 to 1000");
}

// Whether the head is there. Damage and what has not come yet look alike until it is long enough.
bool LiveStreamDecoder::read_head() {
    if (decoder_) return true;
    try {
        ReadHead head = read_stream_head(bytes_, models_);
        decoder_.emplace(std::move(head.tools), head.size);
        taken_ = head.size;
        bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(head.size));
        return true;
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error&) {
        if (bytes_.size() > kLongestHead) throw;
        return false;
    }
}

Motion LiveStreamDecoder::take(bool more) {
    PacketReader reader(bytes_, 0, more);
    std::size_t seen = 0;
    const auto lose = [&] {
        for (; seen < reader.damage().size(); ++seen)
            decoder_->lose(taken_ + reader.damage()[seen].offset, reader.damage()[seen].size,
                           reader.damage()[seen].what);
    };
    while (auto packet = reader.next()) {
        lose();
        packet->offset += taken_;
        decoder_->take(*packet);
    }
    lose();
    taken_ += reader.offset();
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(reader.offset()));
    if (!more) decoder_->finish(taken_);
    return rows();
}

Motion LiveStreamDecoder::feed(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return read_head() ? take(true) : Motion{{}, RowMatrix(0, kCoordinates)};
}

Motion LiveStreamDecoder::finish() {
    if (!decoder_) read_stream_head(bytes_, models_);
    return take(false);
}

// Of the segments that came since the last call.
Motion LiveStreamDecoder::rows() {
    const DecodedStream& stream = decoder_->decoded();
    Motion motion{{}, RowMatrix(0, kCoordinates)};
    const double near = 1e-9;
    for (; segments_ < stream.segments.size(); ++segments_) {
        const DecodedSegment& segment = stream.segments[segments_];
        const auto at = [&](std::int64_t row) {
            return stream.head.start_s + static_cast<double>(row) / rate_hz_;
        };
        next_row_ = std::max(
            next_row_,
            static_cast<std::int64_t>(std::ceil((segment.begin_s - stream.head.start_s) * rate_hz_ - near)));
        for (; at(next_row_) <= segment.end_s + near; ++next_row_) motion.time_s.push_back(at(next_row_));
    }
    motion.positions = stream.positions(motion.time_s);
    return motion;
}

}  // namespace viaface
