#include "viapoints/range_coder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace viaface {
namespace {

constexpr std::uint32_t kSmallestRange = 1u << 24;

// 65536 / (sightings + 1.5)
constexpr auto kStep = [] {
    std::array<std::int32_t, AdaptiveBit::kMostSightings + 1> step{};
    for (std::size_t n = 0; n < step.size(); ++n) step[n] = static_cast<std::int32_t>(131072 / (2 * n + 3));
    return step;
}();

std::uint32_t part_of_one(std::uint32_t range, const AdaptiveBit& context) {
    return static_cast<std::uint32_t>((std::uint64_t{range} * context.one) >> 16);
}

}  // namespace

void AdaptiveBit::see(bool bit) {
    const std::int32_t now = one, goal = bit ? 65536 : 0;
    const std::int32_t moved =
        now + static_cast<std::int32_t>((std::int64_t{goal - now} * kStep[sightings]) / 65536);
    one = static_cast<std::uint16_t>(std::clamp(moved, kLeast, 65536 - kLeast));
    if (sightings < kMostSightings) ++sightings;
}

double bits_of(std::uint16_t one, bool bit) { return 16 - std::log2(bit ? one : 65536.0 - one); }

void RangeEncoder::narrow(std::uint32_t from, std::uint32_t size) {
    low_ += from;
    range_ = size;
    carry();
    while (range_ < kSmallestRange) {
        bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
        low_ = (low_ << 8) & 0xffffffffu;
        range_ <<= 8;
    }
}

void RangeEncoder::carry() {
    if ((low_ >> 32) == 0) return;
    low_ &= 0xffffffffu;
    for (std::size_t i = bytes_.size(); i-- > 0;) {
        if (++bytes_[i] != 0) break;
    }
}

bool RangeEncoder::bit(AdaptiveBit& context, bool value) {
    const std::uint32_t one = part_of_one(range_, context);
    if (value)
        narrow(0, one);
    else
        narrow(one, range_ - one);
    context.see(value);
    return value;
}

std::uint32_t RangeEncoder::even(std::uint32_t value, int bits) {
    const std::uint32_t part = range_ >> bits;
    narrow(part * value, part);
    return value;
}

Bytes RangeEncoder::finish() {
    for (int kept = 0; kept <= 4; ++kept) {
        const std::uint64_t mask = (std::uint64_t{1} << (32 - 8 * kept)) - 1;
        const std::uint64_t value = (low_ + mask) & ~mask;
        if (value >= low_ + range_) continue;
        low_ = value;
        carry();
        for (int i = 0; i < kept; ++i) bytes_.push_back(static_cast<std::uint8_t>(low_ >> (24 - 8 * i)));
        break;
    }
    while (!bytes_.empty() && bytes_.back() == 0) bytes_.pop_back();
    return bytes_;
}

RangeDecoder::RangeDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = (code_ << 8) | next();
}

void RangeDecoder::narrow(std::uint32_t from, std::uint32_t size) {
    code_ -= from;
    range_ = size;
    while (range_ < kSmallestRange) {
        code_ = (code_ << 8) | next();
        range_ <<= 8;
    }
}

bool RangeDecoder::bit(AdaptiveBit& context, bool) {
    const std::uint32_t one = part_of_one(range_, context);
    const bool value = code_ < one;
    if (value)
        narrow(0, one);
    else
        narrow(one, range_ - one);
    context.see(value);
    return value;
}

std::uint32_t RangeDecoder::even(std::uint32_t, int bits) {
    const std::uint32_t part = range_ >> bits;
    const std::uint32_t value = std::min(code_ / part, (1u << bits) - 1);
    narrow(part * value, part);
    return value;
}

}  // namespace viaface
