#include "synth/speech/flite_voice.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "synth/speech/spoken_phones.hpp"
#include "synth/speech/text.hpp"
#include "tests/synth/speech/said.hpp"

namespace viaface {
namespace {

using test::kSentences;
using test::same;

double loudness(const Utterance& said, std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (std::int64_t i = begin; i < end; ++i)
        sum += std::pow(said.sound.samples[static_cast<std::size_t>(i)], 2);
    return std::sqrt(sum / static_cast<double>(end - begin));
}

// The duration of all that is not a pause, s.
double spoken(const Utterance& said) {
    std::int64_t sum = 0;
    for (const TimedPhone& phone : said.phones.phones)
        sum += phone.phone == kPause ? 0 : phone.end - phone.begin;
    return static_cast<double>(sum) / said.sound.sample_rate;
}

class Voices : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Voices, testing::ValuesIn(FliteVoice::names()),
                         [](const auto& i) { return i.param; });

TEST_P(Voices, PhonesAndSoundAgree) {
    const FliteVoice voice(GetParam());
    for (const char* sentence : kSentences) {
        const Utterance said = voice.speak(sentence);
        EXPECT_NO_THROW(check_utterance(said));
        EXPECT_EQ(said.sound.sample_rate, 16000);
        const auto& phones = said.phones.phones;
        const double whole = loudness(said, 0, phones.back().end);
        EXPECT_EQ(phones.front().end, std::llround(kLeadIn * 16000));
        EXPECT_EQ(phones.back().end - phones.back().begin, std::llround(kLeadOut * 16000));
        for (const TimedPhone& phone : phones) {  // vowels sound, the pauses at the ends do not
            EXPECT_TRUE(!phone_info(phone.phone).vowel ||
                        loudness(said, phone.begin, phone.end) > whole / 10);
        }
        EXPECT_LT(loudness(said, 0, phones.front().end / 2), whole / 10);
        EXPECT_LT(loudness(said, phones.back().end - 2000, phones.back().end), whole / 10);
    }
}

TEST_P(Voices, WordsAreThoseSpoken) {
    const Utterance said = FliteVoice(GetParam()).speak("Mr. Smith has 42 cats.");
    std::vector<std::string> words;
    for (const Word& word : said.words) words.push_back(word.text);
    EXPECT_EQ(words, (std::vector<std::string>{"mister", "smith", "has", "forty", "two", "cats"}));
}

TEST_P(Voices, DurationsAskedForAreMet) {
    const FliteVoice voice(GetParam());
    const bool exact = GetParam() == "kal16";
    for (const double rate : {1.0, 1.7}) {
        for (const char* text : {"ax b:90 aa1:220", "m:20 iy1:2000 f:61.7 uw0:100 s:333.3 t:20",
                                 "pau:500 aa1:180 pau:77 m:90 pau:20",
                                 "s:100 t:50 r:40 eh1:150 ng:80 k:60 th:90 s:130", "m:400"}) {
            const auto asked = parse_phones(text);
            const Utterance said = voice.speak_phones(asked, {rate, 1});
            check_utterance(said);
            ASSERT_EQ(said.phones.phones.size(), asked.size());
            for (std::size_t i = 0; i < asked.size(); ++i) {
                EXPECT_EQ(said.phones.phones[i].phone, asked[i].phone);
                EXPECT_EQ(said.phones.phones[i].stress, asked[i].stress);
                if (!asked[i].duration) continue;
                const double ms = 1000 * (said.phones.end_s(i) - said.phones.begin_s(i));
                // half a frame of the 5 ms would be a miss; a pause is cut to the sample
                EXPECT_NEAR(ms, *asked[i].duration, exact || asked[i].phone == kPause ? 0.1 : 0.6)
                    << text << " " << i;
            }
        }
    }
}

TEST_P(Voices, SoundFollowsTheDurationsAskedFor) {
    const Utterance said = FliteVoice(GetParam()).speak_phones(parse_phones("aa1:300 p:200 aa1:300"));
    const auto& phones = said.phones.phones;
    const double vowel = loudness(said, phones[1].begin + 1600, phones[1].end - 1600);
    const double closure = loudness(said, phones[2].begin + 800, phones[2].begin + 1600);
    EXPECT_GT(vowel, 10 * closure);
}

TEST_P(Voices, EqualRequestsGiveEqualBytesInAnyOrder) {
    const FliteVoice voice(GetParam());
    const Utterance first = voice.speak(kSentences[0]);
    const Utterance nonsense = voice.speak_phones(parse_phones("ax b:90 aa1:220"));
    voice.speak(kSentences[1], {0.7, 1.5});
    EXPECT_TRUE(same(voice.speak_phones(parse_phones("ax b:90 aa1:220")), nonsense));
    EXPECT_TRUE(same(FliteVoice(GetParam()).speak(kSentences[0]), first));
    EXPECT_FALSE(same(voice.speak(kSentences[1]), first));
}

TEST_P(Voices, RateAndPitchDoWhatTheySay) {
    const FliteVoice voice(GetParam());
    const double own = spoken(voice.speak(kSentences[0]));
    // States of the statistical voices last at least one frame, which holds some of the fast speech back.
    EXPECT_NEAR(spoken(voice.speak(kSentences[0], {2, 1})) / own, 0.5, 0.03);
    EXPECT_NEAR(spoken(voice.speak(kSentences[0], {0.5, 1})) / own, 2, 0.03);
    const Utterance high = voice.speak(kSentences[0], {1, 2});
    EXPECT_NEAR(spoken(high) / own, 1, 1e-6);
    EXPECT_FALSE(same(high, voice.speak(kSentences[0])));
}

// The period of a steady vowel by the largest autocorrelation between 50 and 500 Hz.
double pitch(const Utterance& said) {
    const TimedPhone vowel = said.phones.phones[1];
    const std::int16_t* x = said.sound.samples.data() + (vowel.begin + vowel.end) / 2 - 1600;
    double best = 0;
    int period = 1;
    for (int lag = 32; lag <= 320; ++lag) {
        const double r = std::inner_product(x, x + 2400, x + lag, 0.0);
        if (r > best * 1.03) {  // multiples of the period do no better
            best = r;
            period = lag;
        }
    }
    return 16000.0 / period;
}

TEST_P(Voices, PitchScalesTheFundamental) {
    const FliteVoice voice(GetParam());
    const auto vowel = parse_phones("aa1:500");
    const double own = pitch(voice.speak_phones(vowel));
    EXPECT_GT(own, 60);
    EXPECT_LT(own, 300);
    EXPECT_NEAR(pitch(voice.speak_phones(vowel, {1, 1.4})) / own, 1.4, 0.1);
}

TEST(FliteVoice, WrongRequestsNameTheirField) {
    const auto field = [](auto&& request) -> std::string {
        try {
            request();
        } catch (const InputError& error) {
            EXPECT_FALSE(error.allowed().empty());
            return error.field();
        }
        return "accepted";
    };
    const FliteVoice voice("kal16");
    for (const char* name : {"", "RMS", "kal", "../x"}) EXPECT_EQ(field([&] { FliteVoice{name}; }), "voice");
    for (const double wrong : {0.49, 2.01, -1.0, 0.0, std::nan(""), HUGE_VAL}) {
        EXPECT_EQ(field([&] { voice.speak("Hello", {wrong, 1}); }), "rate");
        EXPECT_EQ(field([&] { voice.speak("Hello", {1, wrong}); }), "pitch");
        EXPECT_EQ(field([&] { voice.speak_phones(parse_phones("aa"), {1, wrong}); }), "pitch");
    }
    EXPECT_EQ(field([&] { voice.speak("?!"); }), "text");
    EXPECT_EQ(field([&] { voice.speak(""); }), "text");
}

TEST_P(Voices, EveryPhoneOfTheTableIsSpoken) {
    const FliteVoice voice(GetParam());
    std::string all;
    for (const PhoneInfo& phone : phone_table().subspan(1)) all += std::string(phone.name) + " ";
    EXPECT_EQ(voice.speak_phones(parse_phones(all)).phones.phones.size(), phone_table().size() + 1);
    for (const PhoneInfo& phone : phone_table().subspan(1)) {
        EXPECT_EQ(voice.speak_phones(parse_phones(phone.name)).phones.phones.size(), 3u) << phone.name;
    }
}

// What text.hpp lets through, the voices bear: the longest words, digits, signs and capitals of one sentence.
TEST(FliteVoice, SentencesAtTheirLimitsAreSpoken) {
    const FliteVoice voice("kal16");
    for (const std::string& text :
         {std::string(100, '7'), std::string(100, 'a'), std::string(100, 'X'), "1" + std::string(99, '%'),
          "a" + std::string(99, '\''), "$" + std::string(99, '1'), "1" + std::string(98, ',') + "1",
          std::string("1.2.3.4.5-6-7/8/9:10:11"), std::string("-5 $ 1e9 #@ %%% a_b ^~`|{}[]")}) {
        for (const std::string& sentence : sentences(text)) EXPECT_NO_THROW(voice.speak(sentence)) << text;
    }
}

TEST(FliteVoice, TheLocaleOfTheProgramDoesNoHarm) {
    const FliteVoice voice("rms");
    const Utterance plain = voice.speak("It weighs 3.14 grams.");
    const char* set = nullptr;
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C.UTF-8"}) {
        if (!set) set = std::setlocale(LC_ALL, name);
    }
    const Utterance abroad = voice.speak("It weighs 3.14 grams.");
    const auto phones = parse_phones("aa1:90.5");
    std::setlocale(LC_ALL, "C");
    EXPECT_TRUE(same(plain, abroad));
    EXPECT_EQ(phones[1].duration, 90.5);
}

}  // namespace
}  // namespace viaface
