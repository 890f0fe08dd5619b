// Phones to be spoken: with lengths written as text ("pau:200 aa1:150 b:90"), or as a measured talker spoke
// them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "synth/compare/compare_ema.hpp"
#include "viapoints/phones.hpp"

namespace viaface::testing {

inline PhoneSequence spoken(const std::string& text) {
    PhoneSequence sequence;
    std::istringstream in(text);
    std::int64_t at = 0;
    for (std::string item; in >> item;) {
        const std::size_t colon = item.find(':');
        const StressedPhone phone = parse_phone(item.substr(0, colon));
        const std::int64_t length = std::stoll(item.substr(colon + 1)) * sequence.sample_rate / 1000;
        sequence.phones.push_back({phone.phone, phone.stress, at, at + length});
        at += length;
    }
    return sequence;
}

// Moves as the recorded talker did when it says her phones at her times. say: from phones to their motion.
template <class Say>
void expect_follows_a_measured_talker(Say say) {
    const auto folder = std::filesystem::path(VIAFACE_SOURCE_DIR) / ".." / "shared" / "data" / "haskins_f01";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs the recording in " << folder;
    const EmaRecording recording =
        read_ema(folder / "F01_B01_S01_R01_N.csv", folder / "F01_B01_S01_R01_N.phones.txt");
    const EmaComparison result = compare(recording, say(recording.phones));
    EXPECT_GT(result.opening.correlation, 0.8) << report(result);
    EXPECT_GT(result.protrusion.correlation, 0.6) << report(result);
    for (const Agreement& a : {result.opening, result.protrusion, result.jaw}) {
        EXPECT_GT(a.ratio, 0.7) << report(result);
        EXPECT_LT(a.ratio, 1.4) << report(result);
    }
    for (const ClosureTiming& c : result.bilabials)
        EXPECT_NEAR(c.moved_s, c.measured_s, 0.0201) << report(result);
}

}  // namespace viaface::testing
