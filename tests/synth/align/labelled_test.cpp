#include "synth/align/labelled.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "synth/speech/flite_voice.hpp"

namespace viaface {
namespace {

Waveform sound_of(double seconds) {
    return {16000, std::vector<std::int16_t>(static_cast<std::size_t>(seconds * 16000), 5)};
}

TEST(Labelled, GivesBackWhatWasWritten) {
    const Utterance said = FliteVoice("slt").speak("My mother bought a boat, and sold it.");
    TextGrid grid;
    append_to(grid, said, 0);
    const Utterance read = labelled(read_text_grid(write_text_grid(grid)), said.sound, "labels");
    ASSERT_EQ(read.phones.phones.size(), said.phones.phones.size());
    for (std::size_t i = 0; i < said.phones.phones.size(); ++i) {
        EXPECT_EQ(read.phones.phones[i].phone, said.phones.phones[i].phone);
        EXPECT_EQ(read.phones.phones[i].stress, said.phones.phones[i].stress);
        EXPECT_EQ(read.phones.phones[i].end, said.phones.phones[i].end);
    }
    EXPECT_EQ(read.word_of_phone, said.word_of_phone);
    ASSERT_EQ(read.words.size(), said.words.size());
    for (std::size_t i = 0; i < said.words.size(); ++i) EXPECT_EQ(read.words[i].text, said.words[i].text);
}

TEST(Labelled, TakesPhonesWithoutWordsAndWithoutPauses) {
    const TextGrid grid{0, 0.5, {{"phones", {{0, 0.2, "B"}, {0.2, 0.5, "AA1"}}}}};
    const Utterance said = labelled(grid, sound_of(0.5), "labels");
    ASSERT_EQ(said.words.size(), 1u);
    EXPECT_EQ(said.words[0].text, "b-aa");
    EXPECT_EQ(said.phones.phones.size(), 4u);  // with the shortest of pauses around
    EXPECT_NO_THROW(check_utterance(said));
}

TEST(Labelled, NeighbouringPausesAreOne) {
    const TextGrid grid{
        0, 1, {{"phones", {{0.1, 0.2, "sil"}, {0.2, 0.4, "B"}, {0.4, 0.5, "sp"}, {0.6, 0.9, "AA1"}}}}};
    const Utterance said = labelled(grid, sound_of(1), "labels");
    EXPECT_EQ(said.phones.phones.size(), 5u);
    EXPECT_EQ(said.words.size(), 2u);
}

TEST(Labelled, RefusesWhatDoesNotFit) {
    const IntervalTier phones{"phones", {{0, 0.2, "pau"}, {0.2, 0.5, "AA1"}}};
    const auto refused = [](const TextGrid& grid, double seconds) {
        EXPECT_THROW(labelled(grid, sound_of(seconds), "labels"), InputError);
    };
    refused({0, 0.5, {phones}}, 0.7);                                             // the sound is longer
    refused({0, 0.5, {phones}}, 0.4);                                             // and shorter
    refused({0, 0.5, {}}, 0.5);                                                   // no phones
    refused({0, 0.5, {{"phones", {{0, 0.5, "pau"}}}}}, 0.5);                      // only pauses
    refused({0, 0.5, {{"phones", {{0, 0.5, "dog"}}}}}, 0.5);                      // no phone
    refused({0, 0.5, {phones, {"words", {{0, 0.2, "a"}}}}}, 0.5);                 // a phone in no word
    refused({0, 0.52, {{"phones", {{0, 0.51, "b"}, {0.51, 0.52, "aa"}}}}}, 0.5);  // a phone after the end
}

}  // namespace
}  // namespace viaface
