#include "viapoints/stream_model.hpp"

#include <algorithm>
#include <cmath>

#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kMostTables = 16;

void put_bit(ByteWriter& writer, const AdaptiveBit& bit) {
    writer.put(bit.one);
    writer.put(bit.sightings);
}

void take_bit(ByteReader& reader, AdaptiveBit& bit) {
    bit.one = reader.get<std::uint16_t>();
    bit.sightings = reader.get<std::uint8_t>();
    if (bit.one < AdaptiveBit::kLeast || bit.one > 65536 - AdaptiveBit::kLeast ||
        bit.sightings > AdaptiveBit::kMostSightings)
        throw std::runtime_error("no probability before byte " + std::to_string(reader.offset()));
}

Bytes put_tables(const StreamModel& model) {
    ByteWriter writer;
    writer.put(static_cast<std::uint8_t>(model.tables.size()));
    for (StreamStatistics table : model.tables) {
        writer.put(static_cast<std::uint8_t>(table.components));
        writer.put(static_cast<float>(table.bound_mm));
        writer.put(static_cast<float>(table.step_mm));
        for (const std::int32_t weight : table.weights) writer.put(weight);
        for_each_bit(table, [&](AdaptiveBit& bit) { put_bit(writer, bit); });
    }
    return writer.bytes();
}

double take_mm(ByteReader& reader) {
    const auto mm = static_cast<double>(reader.get<float>());
    if (!(mm >= 1e-6 && mm <= 1e6))
        throw std::runtime_error("a length that is none before byte " + std::to_string(reader.offset()));
    return mm;
}

std::vector<StreamStatistics> take_tables(ByteReader& reader, Index modes) {
    const int count = reader.get<std::uint8_t>();
    if (count < 1 || count > kMostTables)
        throw std::runtime_error(std::to_string(count) + " tables, 1 to 16 may be");
    std::vector<StreamStatistics> tables;
    for (int i = 0; i < count; ++i) {
        const int components = reader.get<std::uint8_t>();
        if (components < 1 || components > modes)
            throw std::runtime_error("a table for " + std::to_string(components) + " components");
        StreamStatistics table = plain_statistics(components);
        table.bound_mm = take_mm(reader);
        table.step_mm = take_mm(reader);
        for (std::int32_t& weight : table.weights) weight = reader.get<std::int32_t>();
        for_each_bit(table, [&](AdaptiveBit& bit) { take_bit(reader, bit); });
        if (!tables.empty() && tables.back().bound_mm >= table.bound_mm)
            throw std::runtime_error("tables not rising by bound");
        tables.push_back(std::move(table));
    }
    return tables;
}

ByteReader content_of(const std::vector<ViaChunk>& chunks, std::size_t i, std::string_view type) {
    if (i >= chunks.size() || chunks[i].type != type)
        throw std::runtime_error("stream model: chunk " + std::string(type) + " expected");
    return ByteReader(chunks[i].content);
}

void expect_end(const ByteReader& reader, std::string_view type) {
    if (reader.left() > 0)
        throw std::runtime_error("stream model: chunk " + std::string(type) + ": bytes left over");
}

}  // namespace

Bytes write_stream_model(const StreamModel& model) {
    ViaChunkWriter writer(ViaKind::kStreamModel);
    writer.add("NAME", {reinterpret_cast<const std::uint8_t*>(model.name.data()), model.name.size()});
    ByteWriter mean, modes;
    put_mean(mean, model.basis);
    put_modes(modes, model.basis, 0);
    writer.add("MEAN", mean.bytes());
    writer.add("MODE", modes.bytes());
    writer.add("TABL", put_tables(model));
    return writer.finish();
}

StreamModel read_stream_model(std::span<const std::uint8_t> bytes) {
    std::vector<ViaChunk> chunks = read_chunks(bytes, ViaKind::kStreamModel);
    std::erase_if(chunks, is_optional);
    StreamModel model;
    ByteReader name = content_of(chunks, 0, "NAME"), mean = content_of(chunks, 1, "MEAN"),
               modes = content_of(chunks, 2, "MODE"), tables = content_of(chunks, 3, "TABL");
    if (chunks.size() != 4)
        throw std::runtime_error("stream model: chunk " + std::string(chunks[4].type) + " is not known");
    try {
        if (name.left() < 1 || name.left() > 64) throw std::runtime_error("a name of 1 to 64 bytes expected");
        const auto letters = name.take(name.left());
        model.name.assign(letters.begin(), letters.end());
        model.basis.mean = take_mean(mean);
        model.basis.modes = take_modes(modes, points_of(model.basis));
        model.tables = take_tables(tables, model.basis.size());
    } catch (const std::runtime_error&) {
        std::throw_with_nested(std::runtime_error("stream model"));
    }
    expect_end(mean, "MEAN");
    expect_end(modes, "MODE");
    expect_end(tables, "TABL");
    return model;
}

std::uint32_t StreamModel::identity() const { return crc32(write_stream_model(*this)); }

std::size_t StreamModel::table_for(double bound_mm) const {
    std::size_t best = 0;
    const auto far = [&](std::size_t i) { return std::abs(std::log(tables[i].bound_mm / bound_mm)); };
    for (std::size_t i = 1; i < tables.size(); ++i) {
        if (far(i) < far(best)) best = i;
    }
    return best;
}

}  // namespace viaface
