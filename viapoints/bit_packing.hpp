// Numbers of few bits in bytes, the least significant bit first (FORMAT.md).
#pragma once

#include "base/bytes.hpp"

namespace viaface {

class BitPacker {
  public:
    void put(std::int32_t value, int bits) {
        for (int i = 0; i < bits; ++i, ++used_) {
            if (used_ % 8 == 0) bytes_.push_back(0);
            bytes_.back() |=
                static_cast<std::uint8_t>(((static_cast<std::uint32_t>(value) >> i) & 1u) << (used_ % 8));
        }
    }
    const Bytes& bytes() const { return bytes_; }

  private:
    Bytes bytes_;
    std::size_t used_ = 0;
};

class BitUnpacker {
  public:
    explicit BitUnpacker(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint32_t take(int bits) {
        std::uint32_t value = 0;
        for (int i = 0; i < bits; ++i, ++used_) value |= ((bytes_[used_ / 8] >> (used_ % 8)) & 1u) << i;
        return value;
    }
    std::int32_t take_signed(int bits) {
        const auto value = static_cast<std::int32_t>(take(bits));
        return value >= (1 << (bits - 1)) ? value - (1 << bits) : value;
    }
    bool rest_is_zero() { return take(static_cast<int>(8 * bytes_.size() - used_)) == 0; }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t used_ = 0;
};

}  // namespace viaface
