#include "synth/speech/utterance.hpp"

#include <algorithm>
#include <stdexcept>

namespace viaface {
namespace {

void require(bool holds, const char* law) {
    if (!holds) throw std::logic_error(std::string("utterance: ") + law);
}

void check_phones(const Utterance& utterance) {
    const auto& phones = utterance.phones.phones;
    std::int64_t now = 0;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        require(phones[i].begin == now && phones[i].end > now, "phones are not gapless");
        require((phones[i].phone == kPause) == (utterance.word_of_phone[i] < 0), "a pause in a word");
        require(i == 0 || phones[i].phone != kPause || phones[i - 1].phone != kPause, "two pauses in a row");
        now = phones[i].end;
    }
    require(now == static_cast<std::int64_t>(utterance.sound.samples.size()), "phones and sound end apart");
}

void check_words(const Utterance& utterance) {
    const auto& phones = utterance.phones.phones;
    int last = -1;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        const int word = utterance.word_of_phone[i];
        if (word < 0) continue;
        require(word < static_cast<int>(utterance.words.size()), "a phone of no word");
        if (word != last) {
            require(word == last + 1 && utterance.words[word].begin == phones[i].begin,
                    "a word begins elsewhere");
        }
        const bool is_last = utterance.word_of_phone[i + 1] != word;
        require(!is_last || utterance.words[word].end == phones[i].end, "a word ends elsewhere");
        last = word;
    }
    require(last + 1 == static_cast<int>(utterance.words.size()), "a word without phones");
}

void fade(std::vector<std::int16_t>& samples, std::int64_t from, std::int64_t length, bool out) {
    for (std::int64_t i = 0; i < length; ++i) {
        const std::int64_t gain = out ? length - 1 - i : i;
        auto& sample = samples[static_cast<std::size_t>(from + i)];
        sample = static_cast<std::int16_t>(sample * gain / length);
    }
}

// Times after the place where the sound was cut or lengthened move along.
void shift(Utterance& utterance, std::size_t pause, std::int64_t by) {
    auto& phones = utterance.phones.phones;
    phones[pause].end += by;
    for (std::size_t i = pause + 1; i < phones.size(); ++i) {
        phones[i].begin += by;
        phones[i].end += by;
    }
    for (Word& word : utterance.words) {
        if (word.begin < phones[pause].begin) continue;
        word.begin += by;
        word.end += by;
    }
}

}  // namespace

void check_utterance(const Utterance& utterance) {
    const auto& phones = utterance.phones.phones;
    require(!phones.empty() && phones.size() == utterance.word_of_phone.size(), "no phones");
    require(phones.front().phone == kPause && phones.back().phone == kPause, "no pause at an end");
    require(utterance.phones.sample_rate == utterance.sound.sample_rate, "two sample rates");
    check_phones(utterance);
    check_words(utterance);
}

Utterance with_pause_length(Utterance utterance, std::size_t phone, std::int64_t length) {
    const TimedPhone pause = utterance.phones.phones.at(phone);
    if (pause.phone != kPause || length < 1) throw std::logic_error("only a pause can be given a length");
    const std::int64_t by = length - (pause.end - pause.begin);
    if (by == 0) return utterance;
    const bool first = phone == 0, last = phone + 1 == utterance.phones.phones.size();
    const std::int64_t kept = std::min(length, pause.end - pause.begin);
    const std::int64_t before = first  ? 0
                                : last ? kept
                                       : kept / 2;  // samples of the pause kept before the cut
    const std::int64_t ramp = utterance.sound.sample_rate / 400;
    auto& samples = utterance.sound.samples;
    const auto cut = samples.begin() + pause.begin + before;
    if (by < 0) {
        samples.erase(cut, cut - by);
    } else {
        samples.insert(cut, static_cast<std::size_t>(by), 0);
    }
    const std::int64_t ramp_out = std::min(ramp, before), ramp_in = std::min(ramp, kept - before);
    fade(samples, pause.begin + before - ramp_out, ramp_out, true);
    fade(samples, pause.begin + before + std::max<std::int64_t>(by, 0), ramp_in, false);
    shift(utterance, phone, by);
    return utterance;
}

}  // namespace viaface
