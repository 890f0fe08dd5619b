#include "viapoints/via_stream_head.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::uint8_t kHasTalker = 1, kHasStart = 2, kHasModes = 4, kHasBlends = 8, kHasDirections = 16;
constexpr std::uint8_t kLayout = 1;  // LAYOUT.md with its 38 points

[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error("via stream, head: " + what); }

// A bit for each mode up to the last one that is used.
void put_mode_set(ByteWriter& writer, const std::vector<int>& modes) {
    const int bytes = modes.empty() ? 0 : modes.back() / 8 + 1;
    writer.put(static_cast<std::uint8_t>(bytes));
    for (int byte = 0; byte < bytes; ++byte) {
        int bits = 0;
        for (const int mode : modes) bits |= mode / 8 == byte ? 1 << mode % 8 : 0;
        writer.put(static_cast<std::uint8_t>(bits));
    }
}

std::vector<int> take_mode_set(ByteReader& reader) {
    std::vector<int> modes;
    const int bytes = reader.get<std::uint8_t>();
    for (int byte = 0; byte < bytes; ++byte) {
        const int bits = reader.get<std::uint8_t>();
        for (int i = 0; i < 8; ++i)
            if ((bits >> i) & 1) modes.push_back(8 * byte + i);
    }
    if (modes.size() > kMostStreamComponents) refuse("more than 114 modes");
    return modes;
}

Bytes put_head(const StreamTools& tools) {
    const StreamHead& head = tools.head;
    ByteWriter writer;
    const bool modes = tools.basis.size() > shared_count(head);
    writer.put(static_cast<std::uint8_t>((head.talker.empty() ? 0 : kHasTalker) |
                                         (head.start_s != 0 ? kHasStart : 0) | (modes ? kHasModes : 0) |
                                         (head.blends.cols() > 0 ? kHasBlends : 0) |
                                         (head.directions.count() > 0 ? kHasDirections : 0)));
    writer.put(kLayout);
    put_point_set(writer, head.points);
    writer.put(static_cast<std::uint8_t>(head.ticks_per_s));
    writer.put(static_cast<std::uint16_t>(head.longest_segment));
    writer.put(static_cast<float>(head.bound_mm));
    writer.put(static_cast<float>(head.step_mm));
    if (head.start_s != 0) writer.put(head.start_s);
    if (!head.talker.empty()) {
        writer.put(static_cast<std::uint8_t>(head.talker.size()));
        writer.put_text(head.talker);
        writer.put(head.model_identity);
        writer.put(static_cast<std::uint8_t>(head.table));
        put_mode_set(writer, head.shared_modes);
        if (head.blends.cols() > 0) put_blends(writer, head.blends, head.shared_modes);
        if (head.directions.count() > 0) put_directions(writer, head.directions);
    }
    return writer.bytes();
}

struct TakenHead {
    StreamHead head;
    bool modes = false;
};

TakenHead take_head(ByteReader& reader) {
    TakenHead taken;
    StreamHead& head = taken.head;
    const auto flags = reader.get<std::uint8_t>();
    if (flags > (kHasTalker | kHasStart | kHasModes | kHasBlends | kHasDirections))
        refuse("flags that are not known");
    taken.modes = (flags & kHasModes) != 0;
    if (const auto layout = reader.get<std::uint8_t>(); layout != kLayout)
        refuse("layout " + std::to_string(layout) + ", known is 1");
    head.points = take_point_set(reader);
    head.ticks_per_s = reader.get<std::uint8_t>();
    head.longest_segment = reader.get<std::uint16_t>();
    if (head.ticks_per_s < 1 || head.longest_segment < 1) refuse("no ticks");
    head.bound_mm = static_cast<double>(reader.get<float>());
    head.step_mm = static_cast<double>(reader.get<float>());
    if (!(head.bound_mm > 0 && head.bound_mm < 1e6 && head.step_mm > 0 && head.step_mm < 1e6))
        refuse("a bound or a step that is no length");
    if (flags & kHasStart) head.start_s = reader.get<double>();
    if (!std::isfinite(head.start_s) || std::abs(head.start_s) > 1e9) refuse("a start that is no time");
    if (flags & kHasTalker) {
        const auto name = reader.take(reader.get<std::uint8_t>());
        head.talker.assign(name.begin(), name.end());
        if (head.talker.empty()) refuse("a talker without a name");
        head.model_identity = reader.get<std::uint32_t>();
        head.table = reader.get<std::uint8_t>();
        head.shared_modes = take_mode_set(reader);
        if (flags & kHasBlends) head.blends = take_blends(reader, head.shared_modes);
        if (flags & kHasDirections) head.directions = take_directions(reader);
    } else if (flags & (kHasBlends | kHasDirections)) {
        refuse("blends or directions without a talker");
    }
    if (reader.left() > 0) refuse("bytes left over");
    return taken;
}

const StreamModel& model_of(const StreamHead& head, std::span<const StreamModel* const> models) {
    for (const StreamModel* model : models) {
        if (model->name == head.talker && model->identity() == head.model_identity) return *model;
    }
    throw InputError("talker", head.talker,
                     "a talker at hand whose stream.bin is the one that the stream was made with");
}

ViaChunk required(ByteReader& reader, std::span<const std::uint8_t> bytes, std::string_view type) {
    const ViaChunk chunk = read_via_chunk(reader, bytes);
    if (chunk.type != type)
        refuse("chunk " + std::string(type) + " expected at byte " + std::to_string(chunk.offset - 8));
    return chunk;
}

void check_points(const StreamTools& tools) {
    const std::vector<int> held = points_of(tools.basis);
    if (!std::includes(held.begin(), held.end(), tools.head.points.begin(), tools.head.points.end()))
        refuse("a point that the basis lacks");
}

void share(StreamTools& tools, const StreamModel& model) {
    const StreamHead& head = tools.head;
    if (head.table >= static_cast<int>(model.tables.size()))
        refuse("table " + std::to_string(head.table) + ", the model has " +
               std::to_string(model.tables.size()));
    if (!head.shared_modes.empty() && head.shared_modes.back() >= model.basis.size())
        refuse("a mode that the model lacks");
    if (head.blends.rows() > model.basis.size()) refuse("a blend of a mode that the model lacks");
    if (head.directions.weights.rows() > model.basis.size())
        refuse("a direction in a mode that the model lacks");
    if (shared_count(head) > kMostStreamComponents) refuse("more than 114 modes");
    tools.basis = shared_basis(model, head);
    tools.statistics = shared_statistics(model, head);
}

void append_modes(StreamTools& tools, ByteReader reader) {
    const Eigen::MatrixXd own = take_modes(reader, points_of(tools.basis));
    if (reader.left() > 0) refuse("chunk MODE: bytes left over");
    const Index shared = tools.basis.size();
    if (shared + own.cols() > kMostStreamComponents) refuse("more than 114 modes");
    tools.basis.modes.conservativeResize(kCoordinates, shared + own.cols());
    tools.basis.modes.rightCols(own.cols()) = own;
}

}  // namespace

ConfigurationBasis shared_basis(const StreamModel& model, const StreamHead& head) {
    ConfigurationBasis basis{model.basis.mean, Eigen::MatrixXd(kCoordinates, shared_count(head))};
    basis.modes.leftCols(static_cast<Index>(head.shared_modes.size())) =
        model.basis.modes(Eigen::all, head.shared_modes);
    basis.modes.middleCols(static_cast<Index>(head.shared_modes.size()), head.blends.cols()) =
        blended_modes(model.basis, head.blends);
    basis.modes.rightCols(head.directions.count()) = modes_along(model.basis, head.directions);
    return basis;
}

StreamStatistics shared_statistics(const StreamModel& model, const StreamHead& head) {
    StreamStatistics statistics = with_components(model.tables[static_cast<std::size_t>(head.table)],
                                                  head.shared_modes, static_cast<int>(shared_count(head)));
    set_chances(statistics, static_cast<std::size_t>(shared_count(head) - head.directions.count()),
                head.directions.chance);
    return statistics;
}

Index shared_count(const StreamHead& head) {
    return static_cast<Index>(head.shared_modes.size()) + head.blends.cols() + head.directions.count();
}

Bytes write_stream_head(const StreamTools& tools) {
    ViaChunkWriter writer(ViaKind::kStream);
    writer.add("HEAD", put_head(tools));
    ByteWriter mean, modes;
    if (tools.head.talker.empty()) {
        put_mean(mean, tools.basis);
        writer.add("MEAN", mean.bytes());
    }
    if (tools.basis.size() > shared_count(tools.head)) {
        put_modes(modes, tools.basis, shared_count(tools.head));
        writer.add("MODE", modes.bytes());
    }
    return writer.bytes();
}

ReadHead read_stream_head(std::span<const std::uint8_t> bytes, std::span<const StreamModel* const> models) {
    ByteReader reader(bytes);
    read_via_header(reader, bytes, ViaKind::kStream);
    ByteReader content(required(reader, bytes, "HEAD").content);
    TakenHead taken = take_head(content);
    ReadHead read{{std::move(taken.head),
                   {Configuration::Constant(std::nan("")), Eigen::MatrixXd(kCoordinates, 0)},
                   {}},
                  0};
    StreamTools& tools = read.tools;
    if (!tools.head.talker.empty()) {
        share(tools, model_of(tools.head, models));
    } else {
        ByteReader mean(required(reader, bytes, "MEAN").content);
        tools.basis.mean = take_mean(mean);
        if (mean.left() > 0) refuse("chunk MEAN: bytes left over");
    }
    check_points(tools);
    if (taken.modes) append_modes(tools, ByteReader(required(reader, bytes, "MODE").content));
    if (tools.basis.size() < 1) refuse("no modes");
    tools.statistics = with_components(tools.statistics, static_cast<int>(tools.basis.size()));
    read.size = reader.offset();
    return read;
}

StreamHead peek_stream_head(std::span<const std::uint8_t> bytes) {
    ByteReader reader(bytes);
    read_via_header(reader, bytes, ViaKind::kStream);
    ByteReader content(required(reader, bytes, "HEAD").content);
    return take_head(content).head;
}

}  // namespace viaface
