#include "viapoints/c3d_bytes.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace viaface {
namespace {

double vax_f(std::uint32_t bits) {  // sign, 8 bits of exponent, 23 of fraction, from the high end
    const bool negative = bits >> 31 != 0;
    const auto exponent = static_cast<int>(bits >> 23 & 0xff);
    if (exponent == 0) return negative ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    const double fraction = static_cast<double>((bits & 0x7fffff) | 0x800000) / 0x1000000;
    return std::ldexp(negative ? -fraction : fraction, exponent - 128);
}

std::uint32_t vax_bits(double value) {
    if (value == 0) return 0;
    int exponent = 0;
    const double fraction = std::frexp(static_cast<float>(value), &exponent);  // 0.5 <= |fraction| < 1
    if (exponent + 128 < 1) return 0;
    const auto mantissa = static_cast<std::uint32_t>(std::lround(std::abs(fraction) * 0x1000000));
    return (value < 0 ? 0x80000000u : 0u) | static_cast<std::uint32_t>(exponent + 128) << 23 |
           (mantissa & 0x7fffff);
}

}  // namespace

void C3dBytes::fail(const std::string& value, const std::string& allowed) const {
    throw InputError(field_, value, allowed);
}

std::span<const std::uint8_t> C3dBytes::take(std::size_t at, std::size_t size) const {
    if (size > bytes_.size() || at > bytes_.size() - size)
        fail("the end of the file at byte " + std::to_string(bytes_.size()),
             std::to_string(size) + " more bytes from byte " + std::to_string(at) + " on");
    return bytes_.subspan(at, size);
}

std::uint8_t C3dBytes::u8(std::size_t at) const { return take(at, 1)[0]; }

std::uint16_t C3dBytes::u16(std::size_t at) const {
    const auto b = take(at, 2);
    return processor_ == C3dProcessor::kMips ? static_cast<std::uint16_t>(b[0] << 8 | b[1])
                                             : static_cast<std::uint16_t>(b[1] << 8 | b[0]);
}

double C3dBytes::f32(std::size_t at) const {
    const std::uint32_t first = u16(at), second = u16(at + 2);
    if (processor_ == C3dProcessor::kDec) return vax_f(first << 16 | second);
    return std::bit_cast<float>(processor_ == C3dProcessor::kMips ? first << 16 | second
                                                                  : second << 16 | first);
}

std::string C3dBytes::text(std::size_t at, std::size_t size) const {
    const auto characters = take(at, size);
    return {characters.begin(), characters.end()};
}

void C3dWriter::u16(int value) {
    bytes_.resize(bytes_.size() + 2);
    set_u16(bytes_.size() - 2, value);
}

void C3dWriter::set_u16(std::size_t at, int value) {
    const int low = value & 0xff, high = value >> 8 & 0xff;
    set_u8(at, processor_ == C3dProcessor::kMips ? high : low);
    set_u8(at + 1, processor_ == C3dProcessor::kMips ? low : high);
}

void C3dWriter::f32(double value) {
    const bool dec = processor_ == C3dProcessor::kDec;
    const std::uint32_t bits =
        dec ? vax_bits(value) : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    const auto high = static_cast<int>(bits >> 16), low = static_cast<int>(bits & 0xffff);
    const bool high_first = processor_ != C3dProcessor::kIntel;
    u16(high_first ? high : low);
    u16(high_first ? low : high);
}

void C3dWriter::text(std::string_view characters, std::size_t width) {
    for (std::size_t i = 0; i < width; ++i) u8(i < characters.size() ? characters[i] : ' ');
}

void C3dWriter::fill_block() { bytes_.resize((bytes_.size() + kC3dBlock - 1) / kC3dBlock * kC3dBlock); }

}  // namespace viaface
