#include "viapoints/stream_packets.hpp"

#include <array>

namespace viaface {
namespace {

constexpr std::size_t kChecksum = 4;

bool is_type(std::uint8_t byte) {
    return byte == static_cast<std::uint8_t>(PacketType::kSegment) ||
           byte == static_cast<std::uint8_t>(PacketType::kPhones) ||
           byte == static_cast<std::uint8_t>(PacketType::kEnd);
}

// a b modulo the CRC's polynomial, both with the highest power in the lowest bit.
std::uint32_t times(std::uint32_t a, std::uint32_t b) {
    std::uint32_t product = 0;
    for (std::uint32_t bit = 1u << 31; bit != 0; bit >>= 1) {
        if (a & bit) product ^= b;
        b = (b & 1) ? 0xedb88320u ^ (b >> 1) : b >> 1;
    }
    return product;
}

// What a CRC becomes when n zero bytes' worth of places follow.
std::uint32_t moved_on(std::uint32_t crc, std::size_t n) {
    std::uint32_t square = 1u << 23;  // x^8
    for (; n != 0; n >>= 1) {
        if (n & 1) crc = times(crc, square);
        square = times(square, square);
    }
    return crc;
}

}  // namespace

void put_varint(ByteWriter& writer, std::uint32_t value) {
    for (; value >= 0x80; value >>= 7) writer.put(static_cast<std::uint8_t>(value | 0x80));
    writer.put(static_cast<std::uint8_t>(value));
}

std::uint32_t take_varint(ByteReader& reader) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        const auto byte = reader.get<std::uint8_t>();
        value |= std::uint64_t{byte & 0x7fu} << shift;
        if (byte < 0x80 && value <= 0xffffffffu) return static_cast<std::uint32_t>(value);
        if (byte < 0x80) break;
    }
    throw std::runtime_error("a number over 32 bits before byte " + std::to_string(reader.offset()));
}

Bytes write_packet(PacketType type, std::uint32_t tick, std::span<const std::uint8_t> content) {
    if (content.size() > kLongestPacket) throw std::invalid_argument("a packet over 2^20 bytes");
    ByteWriter writer;
    writer.put(static_cast<std::uint8_t>(type));
    put_varint(writer, static_cast<std::uint32_t>(content.size()));
    put_varint(writer, tick);
    writer.put_bytes(content);
    writer.put(crc32(writer.bytes()));
    return writer.bytes();
}

PacketReader::PacketReader(std::span<const std::uint8_t> bytes, std::size_t offset, bool more)
    : bytes_(bytes), offset_(offset), more_(more) {}

std::uint32_t PacketReader::checksum(std::size_t from, std::size_t to) {
    if (before_.empty()) return crc32(bytes_.subspan(from, to - from));
    return before_[to - before_from_] ^ moved_on(before_[from - before_from_], to - from);
}

PacketReader::Found PacketReader::packet_at(std::size_t offset, StreamPacket& packet) {
    if (!is_type(bytes_[offset])) return Found::kNone;
    ByteReader reader(bytes_.subspan(offset));
    std::uint32_t length = 0;
    try {
        packet.type = static_cast<PacketType>(reader.get<std::uint8_t>());
        length = take_varint(reader);
        packet.tick = take_varint(reader);
    } catch (const std::runtime_error&) {
        return reader.left() == 0 ? Found::kUnfinished : Found::kNone;
    }
    if (length > kLongestPacket) return Found::kNone;
    if (reader.left() < length + kChecksum) return Found::kUnfinished;
    const std::size_t begin = offset + reader.offset();
    packet.content = reader.take(length);
    if (reader.get<std::uint32_t>() != checksum(offset, begin + length)) return Found::kNone;
    packet.offset = offset;
    packet.size = reader.offset();
    return Found::kPacket;
}

std::optional<StreamPacket> PacketReader::next() {
    StreamPacket packet;
    for (std::size_t at = offset_; at < bytes_.size(); ++at) {
        const Found found = packet_at(at, packet);
        if (found != Found::kPacket) {
            if (before_.empty()) count_from(offset_);
            continue;
        }
        if (at > offset_) damage_.push_back({offset_, at - offset_, reason_at(offset_)});
        offset_ = at + packet.size;
        return packet;
    }
    if (offset_ < bytes_.size() && !more_) {
        damage_.push_back({offset_, bytes_.size() - offset_, reason_at(offset_)});
        offset_ = bytes_.size();
    }
    return std::nullopt;
}

void PacketReader::count_from(std::size_t offset) {
    before_from_ = offset;
    before_.assign(1, 0);
    before_.reserve(bytes_.size() - offset + 1);
    std::uint32_t crc = 0;
    for (std::size_t i = offset; i < bytes_.size(); ++i)
        before_.push_back(crc = crc32(bytes_.subspan(i, 1), crc));
}

std::string PacketReader::reason_at(std::size_t offset) const {
    return is_type(bytes_[offset]) ? "its checksum does not fit, or it is cut short"
                                   : "no packet begins here";
}

}  // namespace viaface
