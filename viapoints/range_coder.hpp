// An adaptive binary range coder [Martin79], byte by byte as FORMAT.md has it. Every number is an integer, so
// that all machines agree on every bit.
//
// A range of 32 bits is divided in proportion to 16-bit probabilities; bytes leave at the top, a carry runs
// back into those that have left. A probability moves towards each bit that it sees, by 1 / (sightings + 1.5)
// of the way and never by less than 1/64: like a count at first, forgetful later. What is learned beforehand
// starts with more sightings.
#pragma once

#include "base/bytes.hpp"

namespace viaface {

struct AdaptiveBit {
    std::uint16_t one = 32768;   // probability of a 1, in 1/65536
    std::uint8_t sightings = 0;  // at most kMostSightings

    static constexpr std::uint8_t kMostSightings = 62;
    static constexpr std::int32_t kLeast = 32;  // `one` stays within kLeast and 65536 - kLeast
    void see(bool bit);
};

// What it costs to code `bit` with the probability of a 1 given, in bits.
double bits_of(std::uint16_t one, bool bit);

class RangeEncoder {
  public:
    bool bit(AdaptiveBit& context, bool value);         // returns value
    std::uint32_t even(std::uint32_t value, int bits);  // `bits` equally likely bits, 0 to 16; returns value
    Bytes finish();  // the fewest bytes that decode, without zeros at the end

  private:
    void narrow(std::uint32_t from, std::uint32_t size);
    void carry();

    std::uint64_t low_ = 0;
    std::uint32_t range_ = 0xffffffffu;
    Bytes bytes_;
};

// Reads zeros beyond the end of the bytes. Any bytes decode to something: who calls checks what it is.
class RangeDecoder {
  public:
    explicit RangeDecoder(std::span<const std::uint8_t> bytes);
    bool bit(AdaptiveBit& context, bool = false);
    std::uint32_t even(std::uint32_t, int bits);

  private:
    void narrow(std::uint32_t from, std::uint32_t size);
    std::uint8_t next() { return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0}; }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    std::uint32_t code_ = 0, range_ = 0xffffffffu;
};

}  // namespace viaface
