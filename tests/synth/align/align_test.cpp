// Recordings of a synthesiser, whose own labels tell where each phone begins, and of a person, labelled by
// hand.
#include "synth/align/align.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "synth/compare/compare_ema.hpp"
#include "synth/speech/flite_voice.hpp"

namespace viaface {
namespace {

const std::vector<std::string> kSentences = {"The birch canoe slid on the smooth planks.",
                                             "These days a chicken leg is a rare dish.",
                                             "My mother bought a boat in 1998, and sold it again."};

std::vector<TimedPhone> spoken_in(const PhoneSequence& sequence) {
    std::vector<TimedPhone> phones;
    for (const TimedPhone& phone : sequence.phones) {
        if (phone.phone != kPause) phones.push_back(phone);
    }
    return phones;
}

// How far begins of phones lie from where they should, ms, rising.
std::vector<double> errors_ms(const PhoneSequence& found, const PhoneSequence& truth) {
    const auto a = spoken_in(found), b = spoken_in(truth);
    EXPECT_EQ(a.size(), b.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        EXPECT_EQ(a[i].phone, b[i].phone) << i;
        errors.push_back(1000 * std::abs(static_cast<double>(a[i].begin) / found.sample_rate -
                                         static_cast<double>(b[i].begin) / truth.sample_rate));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

double median(const std::vector<double>& rising) { return rising.at(rising.size() / 2); }
double share_within(const std::vector<double>& rising, double ms) {
    return static_cast<double>(std::upper_bound(rising.begin(), rising.end(), ms) - rising.begin()) /
           static_cast<double>(rising.size());
}

Alignment aligned(const Utterance& said, const std::string& transcript) {
    return align_anyhow(recording_of(said.sound), pronounced(transcript), "transcript");
}

class AlignedVoice : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, AlignedVoice, testing::ValuesIn(FliteVoice::names()),
                         [](const auto& info) { return info.param; });

TEST_P(AlignedVoice, PhonesBeginWhereTheVoiceSaysSo) {
    const FliteVoice voice(GetParam());
    std::vector<double> errors;
    for (const std::string& sentence : kSentences) {
        const Utterance said = voice.speak(sentence);
        const Alignment found = aligned(said, sentence);
        const auto more = errors_ms(found.utterance.phones, said.phones);
        errors.insert(errors.end(), more.begin(), more.end());
        EXPECT_GT(found.confidence, 0.9) << sentence;
        ASSERT_EQ(found.utterance.words.size(), said.words.size());
        EXPECT_EQ(found.loss.size(), said.words.size());
        for (std::size_t i = 0; i < said.words.size(); ++i)
            EXPECT_EQ(found.utterance.words[i].text, said.words[i].text);
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(median(errors), 10);
    EXPECT_GE(share_within(errors, 20), 0.8);
}

TEST_P(AlignedVoice, WordsThatAreNotSaidAreRefused) {
    const Utterance said = FliteVoice(GetParam()).speak(kSentences[0]);
    try {
        align(recording_of(said.sound), pronounced(kSentences[1]), "transcript");
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "transcript");
    }
}

TEST_P(AlignedVoice, PartsOfWhatIsSaidAreRefused) {
    const Recording said = recording_of(FliteVoice(GetParam()).speak(kSentences[0]).sound);
    for (const char* part : {"x", "The birch canoe", "slid on the smooth planks"})
        EXPECT_THROW(align(said, pronounced(part), "transcript"), InputError) << part;
}

TEST(Align, APersonsPhonesBeginWhereTheyWereLabelled) {
    const auto folder = std::filesystem::path(VIAFACE_SOURCE_DIR) / ".." / "shared" / "data" / "haskins_f01";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs the recording in " << folder;
    const auto truth = read_ema(folder / "F01_B01_S01_R01_N.csv", folder / "F01_B01_S01_R01_N.phones.txt");
    const Alignment found = align(read_recording(folder / "F01_B01_S01_R01_N.wav", "audio"),
                                  pronounced("The birch canoe slid on the smooth planks."), "transcript");
    EXPECT_EQ(found.utterance.sound.sample_rate, 44100);
    const auto errors = errors_ms(found.utterance.phones, truth.phones);
    EXPECT_LE(median(errors), 10);
    EXPECT_GE(share_within(errors, 20), 0.8);
}

// White noise that is the same every time, `decibels` below the speech.
Waveform with_noise(Waveform sound, double decibels) {
    double power = 0;
    for (const double s : sound.samples) power += s * s;
    const double rms = std::sqrt(power / static_cast<double>(sound.samples.size()));
    const double range = rms * std::pow(10, -decibels / 20) * std::sqrt(3.0);  // of evenly spread noise
    for (std::uint64_t i = 0; i < sound.samples.size(); ++i) {
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(&i), sizeof i);
        const double noise = static_cast<double>(fnv1a(bytes) >> 11) * 0x1p-52 - 1;
        sound.samples[i] = static_cast<std::int16_t>(
            std::clamp(std::round(sound.samples[i] + range * noise), -32768.0, 32767.0));
    }
    return sound;
}

TEST(Align, NoiseMovesPhonesLittle) {
    std::vector<double> errors;
    for (const std::string& sentence : kSentences) {
        Utterance said = FliteVoice("slt").speak(sentence);
        said.sound = with_noise(std::move(said.sound), 20);
        const auto more = errors_ms(aligned(said, sentence).utterance.phones, said.phones);
        errors.insert(errors.end(), more.begin(), more.end());
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(median(errors), 20);
}

TEST(Align, NoiseAloneIsRefused) {
    Waveform noise{16000, std::vector<std::int16_t>(48000, 1)};
    for (std::int16_t& sample : noise.samples) sample = 3000;
    noise = with_noise(std::move(noise), 0);
    for (std::int16_t& sample : noise.samples) sample = static_cast<std::int16_t>(sample - 3000);
    EXPECT_THROW(align(recording_of(noise), pronounced(kSentences[0]), "transcript"), InputError);
}

TEST(Align, TooShortASoundIsRefused) {
    const Utterance said = FliteVoice("kal16").speak("Yes.");
    for (const double seconds : {0.0, 0.001, 0.02, 0.3}) {
        Waveform cut = said.sound;
        cut.samples.resize(static_cast<std::size_t>(seconds * cut.sample_rate), 7);
        EXPECT_THROW(align(recording_of(cut), pronounced(kSentences[0]), "transcript"), InputError)
            << seconds;
    }
}

TEST(Align, SpeechWithoutPausesAroundItIsAligned) {
    const Utterance said = FliteVoice("slt").speak(kSentences[1]);
    const auto phones = spoken_in(said.phones);
    Waveform tight = said.sound;
    tight.samples.assign(said.sound.samples.begin() + phones.front().begin,
                         said.sound.samples.begin() + phones.back().end);
    const Alignment found = align(recording_of(tight), pronounced(kSentences[1]), "transcript");
    EXPECT_EQ(found.utterance.phones.phones.back().end, std::ssize(tight.samples));
}

TEST(Align, TimesAreOnTheRecordingsOwnClock) {
    const Utterance said = FliteVoice("slt").speak(kSentences[0]);
    const Recording slow = recording_of(said.sound);
    Recording fast = slow;
    fast.sound.sample_rate = 48000;
    fast.sound.samples.clear();
    for (const std::int16_t s : said.sound.samples) fast.sound.samples.insert(fast.sound.samples.end(), 3, s);
    const auto a = align(slow, pronounced(kSentences[0]), "t").utterance.phones.phones;
    const auto b = align(fast, pronounced(kSentences[0]), "t").utterance.phones.phones;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(b[i].end, 3 * a[i].end);
}

TEST(Align, PhonesMayBeGivenInsteadOfWords) {
    const Utterance said = FliteVoice("rms").speak_phones(parse_phones("m aa1 b iy1 pau t uw1 f ae1 s"));
    const Alignment found =
        align(recording_of(said.sound), pronounced_phones("m aa1 b:400 iy1 pau t uw1 f ae1 s"), "phones");
    EXPECT_LE(median(errors_ms(found.utterance.phones, said.phones)), 15);
    EXPECT_EQ(found.utterance.words.size(), 2u);
}

TEST(Align, FourThreadsFindWhatOneFinds) {
    const Utterance said = FliteVoice("rms").speak(kSentences[2]);
    const Alignment alone = aligned(said, kSentences[2]);
    std::vector<Alignment> found(4);
    {
        std::vector<std::jthread> threads;
        for (Alignment& each : found) threads.emplace_back([&] { each = aligned(said, kSentences[2]); });
    }
    for (const Alignment& each : found) {
        EXPECT_EQ(each.loss, alone.loss);
        ASSERT_EQ(each.utterance.phones.phones.size(), alone.utterance.phones.phones.size());
        for (std::size_t i = 0; i < alone.utterance.phones.phones.size(); ++i)
            EXPECT_EQ(each.utterance.phones.phones[i].end, alone.utterance.phones.phones[i].end);
    }
}

TEST(Pronunciation, SpellsOutNumbersAndUnknownWords) {
    const Pronunciation said = pronounced("Glorbix paid 42 dollars.");
    EXPECT_EQ(said.words, (std::vector<std::string>{"glorbix", "paid", "forty", "two", "dollars"}));
    ASSERT_EQ(said.phones.size(), said.word_of_phone.size());
    EXPECT_TRUE(std::is_sorted(said.word_of_phone.begin(), said.word_of_phone.end()));
    EXPECT_EQ(said.word_of_phone.back(), 4);
    for (const StressedPhone& phone : said.phones) EXPECT_NE(phone.phone, kPause);
}

TEST(Pronunciation, RefusesWhatIsNoText) {
    for (const char* text : {"", "...", "\xff", "日本語"}) EXPECT_THROW(pronounced(text), InputError) << text;
    for (const char* phones : {"", "pau", "xx", "b:0"})
        EXPECT_THROW(pronounced_phones(phones), InputError) << phones;
}

}  // namespace
}  // namespace viaface
