// The packets of a stream (FORMAT.md, kind 2): found, checked, and found again after damage.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/bytes.hpp"

namespace viaface {

enum class PacketType : std::uint8_t { kSegment = 0xe1, kPhones = 0xe2, kEnd = 0xef };

inline constexpr std::uint32_t kLongestPacket = 1u << 20;

struct StreamPacket {
    PacketType type{};
    std::uint32_t tick = 0;  // at which what it holds begins
    std::span<const std::uint8_t> content;
    std::size_t offset = 0, size = 0;  // of the whole packet in the bytes
};

// Bytes that are no packet.
struct DamagedBytes {
    std::size_t offset = 0, size = 0;
    std::string what;
};

void put_varint(ByteWriter& writer, std::uint32_t value);
std::uint32_t take_varint(ByteReader& reader);  // std::runtime_error over 32 bits

Bytes write_packet(PacketType type, std::uint32_t tick, std::span<const std::uint8_t> content);

// Walks over packets. What is not one is passed over up to the next byte at which a whole packet with a
// fitting checksum begins; that takes time linear in the bytes, whatever they are.
class PacketReader {
  public:
    // `more` says that bytes may follow these: then an unfinished packet at their end is no damage yet.
    explicit PacketReader(std::span<const std::uint8_t> bytes, std::size_t offset = 0, bool more = false);

    std::optional<StreamPacket> next();  // none at the end of the bytes
    const std::vector<DamagedBytes>& damage() const { return damage_; }
    std::size_t offset() const { return offset_; }  // behind the last packet, or damage

  private:
    enum class Found { kPacket, kNone, kUnfinished };
    Found packet_at(std::size_t offset, StreamPacket& packet);
    std::uint32_t checksum(std::size_t from, std::size_t to);
    std::string reason_at(std::size_t offset) const;

    std::span<const std::uint8_t> bytes_;
    std::size_t offset_;
    bool more_;
    void count_from(std::size_t offset);

    std::size_t before_from_ = 0;
    std::vector<std::uint32_t>
        before_;  // CRC-32 of the bytes from before_from_ to each; from the first damage on
    std::vector<DamagedBytes> damage_;
};

}  // namespace viaface
