// Little-endian bytes, written and read with every bound checked. Readers throw std::runtime_error naming the
// offset.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace viaface {

using Bytes = std::vector<std::uint8_t>;

class ByteWriter {
  public:
    template <class T>
    void put(T value) {
        static_assert(std::is_arithmetic_v<T>);
        append(&value, sizeof value);
    }
    void put_bytes(std::span<const std::uint8_t> bytes) { append(bytes.data(), bytes.size()); }
    void put_text(std::string_view text) { append(text.data(), text.size()); }
    const Bytes& bytes() const { return bytes_; }

  private:
    void append(const void* data, std::size_t size);
    Bytes bytes_;
};

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    template <class T>
    T get() {
        static_assert(std::is_arithmetic_v<T>);
        T value;
        copy(&value, sizeof value);
        return value;
    }
    std::span<const std::uint8_t> take(std::size_t size);
    std::size_t offset() const { return offset_; }
    std::size_t left() const { return bytes_.size() - offset_; }

  private:
    void copy(void* to, std::size_t size);
    std::span<const std::uint8_t> bytes_;
    std::size_t offset_ = 0;
};

// CRC-32 of ISO 3309 (zlib's, PNG's). Chain calls by passing the last result on.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t so_far = 0);

// FNV-1a, 64 bits: names a result in reports; not for security. Chain calls by passing the last result on.
inline constexpr std::uint64_t kFnvStart = 14695981039346656037ull;
std::uint64_t fnv1a(std::span<const std::uint8_t> bytes, std::uint64_t so_far = kFnvStart);

}  // namespace viaface
