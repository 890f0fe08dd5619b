#include "synth/speech/flite_diphones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "synth/speech/flite_utterance.hpp"
#include "synth/speech/flite_voice.hpp"
#include "viapoints/phones.hpp"

extern "C" {
#include <flite/cst_diphone.h>
}

namespace viaface {
namespace {

std::vector<std::string> pairs_that_kal16_lacks() {
    std::vector<std::string> pairs;
    for (const PhoneInfo& a : phone_table()) {
        for (const PhoneInfo& b : phone_table()) {
            if (diphone_in_place_of(a.name, b.name))
                pairs.push_back(std::string(a.name) + " " + std::string(b.name));
        }
    }
    return pairs;
}

// As Flite searches: by halves, in the order of strcmp.
TEST(FliteDiphones, EveryPairOfPhonesIsFound) {
    const cst_diphone_db& whole = whole_diphones();
    const std::span entries(whole.diphones, static_cast<std::size_t>(whole.num_entries));
    const auto name = [](const cst_diphone_entry& entry) { return std::string_view(entry.name); };
    EXPECT_EQ(std::ranges::adjacent_find(entries, std::ranges::greater_equal{}, name), entries.end());
    for (const PhoneInfo& a : phone_table()) {
        for (const PhoneInfo& b : phone_table()) {
            const std::string pair = std::string(a.name) + "-" + std::string(b.name);
            EXPECT_TRUE(std::ranges::binary_search(entries, pair, {}, name)) << pair;
        }
    }
}

TEST(FliteDiphones, StandInsAreThoseStated) {
    EXPECT_EQ(pairs_that_kal16_lacks().size(), 97u);
    EXPECT_EQ(diphone_in_place_of("k", "ng"), "k-n");
    EXPECT_EQ(diphone_in_place_of("w", "pau"), "uw-pau");
    EXPECT_EQ(diphone_in_place_of("y", "m"), "iy-m");
    EXPECT_EQ(diphone_in_place_of("hh", "ng"), "th-n");
    EXPECT_EQ(diphone_in_place_of("aa", "ng"), std::nullopt);
    const cst_diphone_db& whole = whole_diphones();
    const auto entry = [&](std::string_view name) {
        return *std::ranges::find(whole.diphones, whole.diphones + whole.num_entries, name,
                                  [](const auto& e) { return std::string_view(e.name); });
    };
    EXPECT_EQ(entry("k-ng").start_pm, entry("k-n").start_pm);
    EXPECT_NE(entry("k-ng").start_pm, entry("k-m").start_pm);
}

TEST(FliteDiphones, WhatKal16LacksIsSpokenUnderItsOwnNameWithoutAWord) {
    const FliteVoice voice("kal16");
    testing::internal::CaptureStderr();
    for (const std::string& pair : pairs_that_kal16_lacks()) {
        const auto asked = parse_phones("aa:100 " + pair + " aa:100");
        const Utterance said = voice.speak_phones(asked);
        ASSERT_EQ(said.phones.phones.size(), asked.size()) << pair;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            EXPECT_EQ(said.phones.phones[i].phone, asked[i].phone) << pair;
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(FliteUtterance, WhatFliteComplainsOfIsAnErrorAndNotPrinted) {
    const FliteUtterance utterance(new_utterance());
    const auto complaining = [](cst_utterance* spoken) {
        cst_errmsg("flite: no %s here\n", "ng");
        return spoken;
    };
    testing::internal::CaptureStderr();
    try {
        run(utterance.get(), complaining);
        ADD_FAILURE() << "went on";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "Flite failed to speak: flite: no ng here");
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_NO_THROW(run(utterance.get(), [](cst_utterance* spoken) { return spoken; }));
}

}  // namespace
}  // namespace viaface
