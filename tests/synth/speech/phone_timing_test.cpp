#include "synth/speech/phone_timing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

std::string syllables(const char* text) {
    const auto phones = parse_phones(text);
    std::string cut;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone == kPause) continue;
        if (begins_word(phones, i)) {
            cut += " ";
        } else if (begins_syllable(phones, i)) {
            cut += ".";
        }
        cut += phone_info(phones[i].phone).name;
    }
    return cut;
}

TEST(PhoneTiming, ConsonantsGoWithTheVowelAfterThem) {
    EXPECT_EQ(syllables("b aa t iy"), " baa.tiy");
    EXPECT_EQ(syllables("b aa t pau iy"), " baat iy");
    EXPECT_EQ(syllables("aa iy s t"), " aa.iyst");
    EXPECT_EQ(syllables("s t"), " st");
}

TEST(PhoneTiming, AWordIsSpeltFromPauseToPause) {
    const auto phones = parse_phones("b aa t pau iy");
    EXPECT_EQ(spelt_word(phones, 1), "b-aa-t");
    EXPECT_EQ(spelt_word(phones, 5), "iy");
}

// A synthesiser of 5 ms frames that shortens no phone below three of them.
TEST(PhoneTiming, StretchesMeetWhatIsAskedFor) {
    const auto phones = parse_phones("b:60 aa:220 t");
    const auto durations = [](std::span<const double> factors) {
        std::vector<double> ms;
        for (const double factor : factors) ms.push_back(5 * std::max(3.0, std::round(13.4 * factor)));
        return ms;
    };
    const auto met = durations(stretches_for(phones, durations));
    EXPECT_EQ(met[1], 60);
    EXPECT_EQ(met[2], 220);
    EXPECT_EQ(met[3], 65);  // not asked for: its own
}

TEST(PhoneTiming, StretchesThatDoNothingAreRefused) {
    const auto phones = parse_phones("b:60");
    const auto deaf = [](std::span<const double> factors) { return std::vector<double>(factors.size(), 80); };
    EXPECT_THROW(stretches_for(phones, deaf), std::runtime_error);
}

TEST(PhoneTiming, EndsMoveByWhatIsAskedForOutsidePauses) {
    const auto phones = parse_phones("pau:300 b:60 aa");
    const std::vector<double> own = {0.2, 0.28, 0.4, 0.6};
    const auto ends = ends_asked_for(own, phones);
    ASSERT_EQ(ends.size(), 4u);
    EXPECT_EQ(ends[0], 0.2);  // a pause keeps its own
    EXPECT_NEAR(ends[1], 0.26, 1e-12);
    EXPECT_NEAR(ends[2], 0.38, 1e-12);
    EXPECT_NEAR(ends[3], 0.58, 1e-12);
}

}  // namespace
}  // namespace viaface
