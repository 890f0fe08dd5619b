#include "synth/speech/utterance.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace viaface {
namespace {

Utterance two_words() {
    Utterance said;
    said.phones.phones = {
        {0, 0, 0, 100}, {8, 0, 100, 200}, {0, 0, 200, 300}, {1, 1, 300, 400}, {0, 0, 400, 500}};
    said.word_of_phone = {-1, 0, -1, 1, -1};
    said.words = {{"b", 100, 200}, {"ah", 300, 400}};
    said.sound.samples.resize(500);
    std::iota(said.sound.samples.begin(), said.sound.samples.end(), std::int16_t{1});
    return said;
}

TEST(Utterance, PausesTakeAnyLengthAndWordsKeepTheirSound) {
    const Utterance said = two_words();
    for (const std::size_t pause : {0u, 2u, 4u}) {
        for (const std::int64_t length : {1, 40, 99, 100, 101, 1000}) {
            const Utterance changed = with_pause_length(said, pause, length);
            check_utterance(changed);
            EXPECT_EQ(changed.phones.phones[pause].end - changed.phones.phones[pause].begin, length);
            for (std::size_t word = 0; word < 2; ++word) {
                const Word &old = said.words[word], &now = changed.words[word];
                ASSERT_EQ(now.end - now.begin, 100);
                for (int i = 0; i < 100; ++i) {
                    ASSERT_EQ(changed.sound.samples[now.begin + i], said.sound.samples[old.begin + i]);
                }
            }
        }
    }
}

TEST(Utterance, SilenceGoesToTheOuterEdgesAndTheMiddle) {
    EXPECT_EQ(with_pause_length(two_words(), 0, 150).sound.samples[0], 0);
    EXPECT_EQ(with_pause_length(two_words(), 4, 150).sound.samples.back(), 0);
    const auto middle = with_pause_length(two_words(), 2, 150).sound.samples;
    EXPECT_EQ(middle[200], 201);
    EXPECT_EQ(middle[250], 0);
    EXPECT_EQ(middle[299], 0);
    EXPECT_EQ(middle[349], 300);
}

TEST(Utterance, BrokenOnesAreNoticed) {
    check_utterance(two_words());
    const auto broken = [](auto&& harm) {
        Utterance said = two_words();
        harm(said);
        EXPECT_THROW(check_utterance(said), std::logic_error);
    };
    broken([](Utterance& said) { said.sound.samples.pop_back(); });
    broken([](Utterance& said) { said.phones.phones[1].end = 199; });
    broken([](Utterance& said) { said.words[1].end = 399; });
    broken([](Utterance& said) { said.words.push_back({"x", 400, 400}); });
    broken([](Utterance& said) { said.word_of_phone[1] = -1; });
    broken([](Utterance& said) { said.phones.phones.clear(); });
    broken([](Utterance& said) { said.phones.sample_rate = 8000; });
    EXPECT_THROW(with_pause_length(two_words(), 1, 50), std::logic_error);
    EXPECT_THROW(with_pause_length(two_words(), 0, 0), std::logic_error);
}

}  // namespace
}  // namespace viaface
