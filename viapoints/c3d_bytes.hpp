// Numbers of a C3D file in the byte orders of its three processors: Intel and DEC little-endian, MIPS
// big-endian; floats IEEE 754 for Intel and MIPS, VAX F for DEC (words swapped, 0.1f x 2^(e - 128)).
#pragma once

#include <span>
#include <string>

#include "base/bytes.hpp"

namespace viaface {

enum class C3dProcessor : std::uint8_t { kIntel = 84, kDec = 85, kMips = 86 };
inline constexpr std::size_t kC3dBlock = 512;  // bytes

// Reads at any offset. InputError(field, ...) with the offset when a number lies beyond the end.
class C3dBytes {
  public:
    C3dBytes(std::span<const std::uint8_t> bytes, std::string field)
        : bytes_(bytes), field_(std::move(field)) {}

    void set_processor(C3dProcessor processor) { processor_ = processor; }
    const std::string& field() const { return field_; }
    std::size_t size() const { return bytes_.size(); }

    std::uint8_t u8(std::size_t at) const;
    std::int8_t i8(std::size_t at) const { return static_cast<std::int8_t>(u8(at)); }
    std::uint16_t u16(std::size_t at) const;
    std::int16_t i16(std::size_t at) const { return static_cast<std::int16_t>(u16(at)); }
    double f32(std::size_t at) const;  // NaN for VAX F's reserved operand
    std::string text(std::size_t at, std::size_t size) const;

    // What is wrong, said with the file's name.
    [[noreturn]] void fail(const std::string& value, const std::string& allowed) const;

  private:
    std::span<const std::uint8_t> take(std::size_t at, std::size_t size) const;

    std::span<const std::uint8_t> bytes_;
    std::string field_;
    C3dProcessor processor_ = C3dProcessor::kIntel;
};

// The same, written one behind the other.
class C3dWriter {
  public:
    explicit C3dWriter(C3dProcessor processor) : processor_(processor) {}

    void u8(int value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }
    void u16(int value);
    void f32(double value);
    void text(std::string_view characters, std::size_t width);  // padded with spaces
    void fill_block();                                          // with zeros up to the next block
    void set_u8(std::size_t at, int value) { bytes_.at(at) = static_cast<std::uint8_t>(value); }
    void set_u16(std::size_t at, int value);
    const Bytes& bytes() const { return bytes_; }
    std::size_t size() const { return bytes_.size(); }

  private:
    C3dProcessor processor_;
    Bytes bytes_;
};

}  // namespace viaface
