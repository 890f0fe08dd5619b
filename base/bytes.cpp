#include "base/bytes.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace viaface {

static_assert(std::endian::native == std::endian::little);

void ByteWriter::append(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
}

std::span<const std::uint8_t> ByteReader::take(std::size_t size) {
    if (size > left()) {
        throw std::runtime_error("cut short at byte " + std::to_string(offset_) + ": " +
                                 std::to_string(size) + " wanted, " + std::to_string(left()) + " left");
    }
    const auto taken = bytes_.subspan(offset_, size);
    offset_ += size;
    return taken;
}

void ByteReader::copy(void* to, std::size_t size) { std::memcpy(to, take(size).data(), size); }

namespace {

constexpr std::array<std::uint32_t, 256> make_crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int k = 0; k < 8; ++k) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
        table[n] = c;
    }
    return table;
}

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t so_far) {
    static constexpr auto kTable = make_crc_table();
    std::uint32_t crc = so_far ^ 0xffffffffu;
    for (const std::uint8_t byte : bytes) crc = kTable[(crc ^ byte) & 0xff] ^ (crc >> 8);
    return crc ^ 0xffffffffu;
}

std::uint64_t fnv1a(std::span<const std::uint8_t> bytes, std::uint64_t so_far) {
    std::uint64_t hash = so_far;
    for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
    return hash;
}

}  // namespace viaface
