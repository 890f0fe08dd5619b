#include "synth/speech/text_grid.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "synth/speech/flite_voice.hpp"

namespace viaface {
namespace {

std::string refusal(const std::string& text) {
    try {
        read_text_grid(text);
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "labels");
        return error.value();
    }
    ADD_FAILURE() << "accepted";
    return "";
}

void expect_equal(const TextGrid& a, const TextGrid& b) {
    EXPECT_EQ(a.begin, b.begin);
    EXPECT_EQ(a.end, b.end);
    ASSERT_EQ(a.tiers.size(), b.tiers.size());
    for (std::size_t t = 0; t < a.tiers.size(); ++t) {
        EXPECT_EQ(a.tiers[t].name, b.tiers[t].name);
        ASSERT_EQ(a.tiers[t].intervals.size(), b.tiers[t].intervals.size());
        for (std::size_t i = 0; i < a.tiers[t].intervals.size(); ++i) {
            EXPECT_EQ(a.tiers[t].intervals[i].begin, b.tiers[t].intervals[i].begin);
            EXPECT_EQ(a.tiers[t].intervals[i].end, b.tiers[t].intervals[i].end);
            EXPECT_EQ(a.tiers[t].intervals[i].text, b.tiers[t].intervals[i].text);
        }
    }
}

TextGrid spoken() {
    TextGrid grid;
    const FliteVoice voice("kal16");
    const Utterance first = voice.speak("An old man, and a woman.");
    append_to(grid, first, 0);
    append_to(grid, voice.speak("They lived."), static_cast<std::int64_t>(first.sound.samples.size()));
    return grid;
}

TEST(TextGrid, ReadsBackToTheSameBits) {
    const TextGrid grid = spoken();
    expect_equal(read_text_grid(write_text_grid(grid)), grid);
    const TextGrid odd{
        0.1, 1.0 / 3, {{"a \"b\" ! <c> 7", {{0.1, 0.2, "\"\""}, {0.2, 1.0 / 3, "say \"é\"\n2"}}}, {"", {}}}};
    expect_equal(read_text_grid(write_text_grid(odd)), odd);
}

TEST(TextGrid, TiersCoverTheWholeWithoutGaps) {
    const TextGrid grid = spoken();
    ASSERT_EQ(grid.tiers.size(), 2u);
    for (const IntervalTier& tier : grid.tiers) {
        double now = 0;
        for (std::size_t i = 0; i < tier.intervals.size(); ++i) {
            EXPECT_EQ(tier.intervals[i].begin, now);
            now = tier.intervals[i].end;
            const bool silent = tier.intervals[i].text.empty() || tier.intervals[i].text == "pau";
            EXPECT_FALSE(i > 0 && silent && tier.intervals[i].text == tier.intervals[i - 1].text);
        }
        EXPECT_EQ(now, grid.end);
    }
    EXPECT_EQ(grid.tiers[0].name, "words");
    EXPECT_EQ(grid.tiers[0].intervals[1].text, "an");
    EXPECT_EQ(grid.tiers[1].intervals[1].text, "AE1");
}

TEST(TextGrid, PhonesComeBackOnTheSampleClock) {
    const Utterance said = FliteVoice("kal16").speak("An old man.");
    TextGrid grid;
    append_to(grid, said, 0);
    const PhoneSequence back = phones_of(read_text_grid(write_text_grid(grid)), said.sound.sample_rate);
    ASSERT_EQ(back.phones.size(), said.phones.phones.size());
    for (std::size_t i = 0; i < back.phones.size(); ++i) {
        EXPECT_EQ(back.phones[i].phone, said.phones.phones[i].phone);
        EXPECT_EQ(back.phones[i].stress, said.phones.phones[i].stress);
        EXPECT_EQ(back.phones[i].begin, said.phones.phones[i].begin);
        EXPECT_EQ(back.phones[i].end, said.phones.phones[i].end);
    }
}

TEST(TextGrid, TheShortFormatAndPointTiersAreRead) {
    const TextGrid grid = read_text_grid(
        "\xef\xbb\xbf"
        "File type = \"ooTextFile\"\r\nObject class = \"TextGrid\"\r\n\r\n0\r\n2\r\n<exists>\r\n2\r\n"
        "\"TextTier\"\r\n\"bells\"\r\n0\r\n2\r\n1\r\n0.5\r\n\"ding\"\r\n"
        "\"IntervalTier\"\r\n\"phones\"\r\n0\r\n2\r\n2\r\n0\r\n0.5\r\n\"\"\r\n0.75\r\n1.5\r\n\"iy1\" ! a "
        "comment \"\r\n");
    ASSERT_EQ(grid.tiers.size(), 1u);
    const PhoneSequence phones = phones_of(grid, 1000);
    ASSERT_EQ(phones.phones.size(), 4u);
    EXPECT_EQ(phones.phones[2].begin, 750);
    EXPECT_EQ(phones.phones[2].stress, 1);
    EXPECT_EQ(phones.phones[3].end, 2000);
}

TEST(TextGrid, EveryTruncationIsRefused) {
    const std::string text = write_text_grid({0, 1, {{"phones", {{0, 0.5, "AA1"}, {0.5, 1, "pau"}}}}});
    for (std::size_t size = 0; size + 2 < text.size(); ++size) refusal(text.substr(0, size));
    EXPECT_EQ(refusal("").find("line 1"), 0u);
}

TEST(TextGrid, WhatIsWrongIsNamedWithItsLine) {
    const std::string text = write_text_grid({0, 1, {{"phones", {{0, 0.5, "AA1"}, {0.5, 1, "QQ"}}}}});
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        return changed;
    };
    EXPECT_EQ(refusal(with("TextGrid", "Pitch")), "line 2: Pitch");
    EXPECT_EQ(refusal(with("xmax = 0.5", "xmax = -0.5")), "line 17: 0 to -0.5");
    refusal(with("IntervalTier", "Tier"));
    refusal(with("size = 2", "size = 99999999999"));
    refusal(with("size = 2", "size = -1"));
    refusal(with("xmax = 1", "xmax = 1e999"));
    refusal(with("xmax = 1", "xmax = 1x"));
    refusal(with("xmax = 1", "xmax = 1e300"));
    EXPECT_THROW(phones_of(read_text_grid(text), 16000), InputError);
    EXPECT_THROW(phones_of({0, 1, {}}, 16000), InputError);
}

}  // namespace
}  // namespace viaface
