#include "viapoints/range_coder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace viaface {
namespace {

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 1) {}
    std::uint32_t next() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<std::uint32_t>(state_ >> 33);
    }
    bool with(double probability) { return next() < probability * 2147483648.0; }

  private:
    std::uint64_t state_;
};

TEST(RangeCoder, GivesBackWhatItWasGiven) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Random random(seed);
        const double share = 0.001 + 0.02 * static_cast<double>(seed);
        std::vector<std::pair<int, std::uint32_t>> told;  // bits, or 0 for a coded bit
        for (int i = 0; i < 400; ++i) {
            const int bits = random.with(0.8) ? 0 : 1 + static_cast<int>(random.next() % 16);
            told.emplace_back(bits, bits == 0 ? random.with(share) : random.next() & ((1u << bits) - 1));
        }
        RangeEncoder encoder;
        AdaptiveBit context;
        for (const auto& [bits, value] : told) {
            if (bits == 0) {
                encoder.bit(context, value != 0);
            } else {
                encoder.even(value, bits);
            }
        }
        const Bytes bytes = encoder.finish();
        RangeDecoder decoder(bytes);
        AdaptiveBit again;
        for (const auto& [bits, value] : told)
            ASSERT_EQ(bits == 0 ? decoder.bit(again) : decoder.even(0, bits), value) << seed;
    }
}

// A carry that runs through many bytes: even values of all ones at the top of the range.
TEST(RangeCoder, CarriesRunBack) {
    for (int n = 1; n < 60; ++n) {
        RangeEncoder encoder;
        for (int i = 0; i < n; ++i) encoder.even(255, 8);
        encoder.even(1, 1);
        encoder.even(3, 3);
        const Bytes bytes = encoder.finish();
        RangeDecoder decoder(bytes);
        for (int i = 0; i < n; ++i) ASSERT_EQ(decoder.even(0, 8), 255u);
        ASSERT_EQ(decoder.even(0, 1), 1u);
        ASSERT_EQ(decoder.even(0, 3), 3u);
    }
}

// The bytes of 100000 choices lie within 1% of their entropy at the probabilities the coder holds.
TEST(RangeCoder, ComesWithinOnePercentOfTheEntropyOfItsModel) {
    for (const double share : {0.02, 0.1, 0.3, 0.5}) {
        Random random(7);
        RangeEncoder encoder;
        AdaptiveBit context, meter;
        double bits = 0;
        for (int i = 0; i < 100000; ++i) {
            const bool bit = random.with(share);
            bits += bits_of(meter.one, bit);
            meter.see(bit);
            encoder.bit(context, bit);
        }
        const double spent = 8.0 * static_cast<double>(encoder.finish().size());
        EXPECT_NEAR(spent / bits, 1, 0.01) << share;
        const double entropy = -100000 * (share * std::log2(share) + (1 - share) * std::log2(1 - share));
        EXPECT_LT(spent - entropy, 100000 * 0.0115)
            << share;  // an estimate from some 63 sightings costs 1 / (126 ln 2) bits
    }
}

TEST(RangeCoder, NothingCostsNoByte) { EXPECT_TRUE(RangeEncoder().finish().empty()); }

}  // namespace
}  // namespace viaface
