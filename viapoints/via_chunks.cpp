#include "viapoints/via_chunks.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace viaface {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'V', 'I', 'A', '\r', '\n', 0x1a, '\n'};
constexpr std::string_view kEnd = "ENDS";

[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error("via bytes: " + what); }

}  // namespace

void read_via_header(ByteReader& reader, std::span<const std::uint8_t> bytes, ViaKind kind) {
    const auto magic = reader.take(kMagic.size());
    if (!std::equal(magic.begin(), magic.end(), kMagic.begin()))
        refuse("not a .via file: its first 8 bytes are others");
    const auto version = reader.get<std::uint16_t>(), found = reader.get<std::uint16_t>();
    if (crc32(bytes.first(reader.offset())) != reader.get<std::uint32_t>())
        refuse("the header's checksum does not fit (byte 12)");
    if (found != static_cast<std::uint16_t>(kind))
        refuse("kind " + std::to_string(found) + ", wanted " + std::to_string(static_cast<int>(kind)));
    if (version != via_version(kind))
        refuse("version " + std::to_string(version) + ", known is " + std::to_string(via_version(kind)));
}

ViaChunk read_via_chunk(ByteReader& reader, std::span<const std::uint8_t> bytes) {
    const std::size_t begin = reader.offset();
    const auto name = reader.take(4);
    if (!std::all_of(name.begin(), name.end(), [](std::uint8_t c) { return c < 0x80 && std::isalpha(c); })) {
        refuse("no chunk type at byte " + std::to_string(begin));
    }
    const std::string_view type(reinterpret_cast<const char*>(name.data()), name.size());
    const std::string where = "chunk " + std::string(type) + " at byte " + std::to_string(begin);
    const auto length = reader.get<std::uint32_t>();
    if (length > kLongestViaChunk || reader.left() < length + std::size_t{4}) {
        refuse(where + ": a content of " + std::to_string(length) + " bytes, " +
               std::to_string(reader.left()) + " bytes left");
    }
    const std::size_t offset = reader.offset();
    const auto content = reader.take(length);
    if (crc32(bytes.subspan(begin, 8 + length)) != reader.get<std::uint32_t>())
        refuse(where + ": its checksum does not fit");
    return {type, content, offset};
}

ViaChunkWriter::ViaChunkWriter(ViaKind kind) {
    writer_.put_bytes(kMagic);
    writer_.put(via_version(kind));
    writer_.put(static_cast<std::uint16_t>(kind));
    writer_.put(crc32(writer_.bytes()));
}

void ViaChunkWriter::add(std::string_view type, std::span<const std::uint8_t> content) {
    if (content.size() > kLongestViaChunk)
        throw std::invalid_argument("via bytes: chunk " + std::string(type) + " is too long");
    const std::size_t begin = writer_.bytes().size();
    writer_.put_text(type);
    writer_.put(static_cast<std::uint32_t>(content.size()));
    writer_.put_bytes(content);
    writer_.put(crc32(std::span(writer_.bytes()).subspan(begin)));
}

Bytes ViaChunkWriter::finish() {
    add(kEnd, {});
    return writer_.bytes();
}

std::vector<ViaChunk> read_chunks(std::span<const std::uint8_t> bytes, ViaKind kind) {
    ByteReader reader(bytes);
    read_via_header(reader, bytes, kind);
    std::vector<ViaChunk> chunks;
    for (;;) {
        const ViaChunk chunk = read_via_chunk(reader, bytes);
        if (chunk.type == kEnd) {
            if (!chunk.content.empty()) refuse("chunk ENDS has a content");
            if (reader.left() > 0)
                refuse(std::to_string(reader.left()) + " bytes after the end at byte " +
                       std::to_string(reader.offset()));
            return chunks;
        }
        chunks.push_back(chunk);
    }
}

}  // namespace viaface
