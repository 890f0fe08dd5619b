#include "synth/align/labelled.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr std::int64_t kShortest = 2;  // samples of the first and the last pause

std::string printed(const char* format, auto... values) {
    char text[120];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

// One pause where there were several, one at either end, and the end where the sound ends.
PhoneSequence fitted(PhoneSequence labels, std::int64_t samples, const std::string& field) {
    PhoneSequence fitted{labels.sample_rate, {}};
    auto& phones = fitted.phones;
    const auto pause = [&](std::int64_t begin, std::int64_t end) {
        if (!phones.empty() && phones.back().phone == kPause) {
            phones.back().end = end;
        } else if (end > begin) {
            phones.push_back({kPause, 0, begin, end});
        }
    };
    for (const TimedPhone& phone : labels.phones) {
        const std::int64_t begin = phones.empty() ? 0 : phones.back().end;
        const std::int64_t end = std::min(phone.end, samples);
        if (phone.phone == kPause) {
            pause(begin, end);
            continue;
        }
        if (phones.empty()) pause(0, kShortest);
        const std::int64_t from = phones.back().end, to = std::min(end, samples - kShortest);
        if (to - from < kShortest) {
            throw InputError(field,
                             printed("%s at %.3f s", phone_info(phone.phone).name.data(),
                                     static_cast<double>(begin) / labels.sample_rate),
                             "phones of at least two samples within the sound");
        }
        phones.push_back({phone.phone, phone.stress, from, to});
    }
    pause(phones.empty() ? 0 : phones.back().end, samples);
    return fitted;
}

std::string spelt(const std::vector<TimedPhone>& phones, std::size_t first) {
    std::string word;
    for (std::size_t i = first; i < phones.size() && phones[i].phone != kPause; ++i) {
        word += (word.empty() ? "" : "-") + std::string(phone_info(phones[i].phone).name);
    }
    return word;
}

const IntervalTier* word_tier(const TextGrid& grid) {
    const auto tier =
        std::find_if(grid.tiers.begin(), grid.tiers.end(), [](auto& t) { return t.name == "words"; });
    return tier == grid.tiers.end() ? nullptr : &*tier;
}

// The label of the tier around a phone's middle.
const LabelledInterval& word_at(const TextGrid& grid, const IntervalTier& words, double middle_s,
                                const std::string& field) {
    for (const LabelledInterval& word : words.intervals) {
        const bool around = word.begin - grid.begin <= middle_s && middle_s < word.end - grid.begin;
        if (around && !word.text.empty() && word.text != "pau") return word;
    }
    throw InputError(field, printed("a phone at %.3f s", middle_s),
                     "phones that lie in a label of the tier \"words\"");
}

void add_words(Utterance& said, const TextGrid& grid, const std::string& field) {
    const IntervalTier* words = word_tier(grid);
    const auto& phones = said.phones.phones;
    const LabelledInterval* last = nullptr;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone == kPause) {
            said.word_of_phone.push_back(-1);
            last = nullptr;
            continue;
        }
        const double middle = (said.phones.begin_s(i) + said.phones.end_s(i)) / 2;
        const LabelledInterval* word = words ? &word_at(grid, *words, middle, field) : nullptr;
        const bool begins = said.word_of_phone.back() < 0 || (words && word != last);
        if (begins) said.words.push_back({word ? word->text : spelt(phones, i), phones[i].begin, 0});
        said.words.back().end = phones[i].end;
        said.word_of_phone.push_back(static_cast<int>(said.words.size()) - 1);
        last = word;
    }
}

}  // namespace

Utterance labelled(const TextGrid& grid, Waveform sound, const std::string& field) {
    const double labels_s = grid.end - grid.begin;
    if (!(std::abs(labels_s - sound.seconds()) <= kLabelsEndApart)) {
        throw InputError(field, printed("%.3f s of labels", labels_s),
                         printed("labels as long as the sound, %.3f s, within 0.05 s", sound.seconds()));
    }
    Utterance said;
    said.phones = fitted(phones_of(grid, sound.sample_rate), std::ssize(sound.samples), field);
    said.sound = std::move(sound);
    if (said.phones.phones.size() < 2) throw InputError(field, "only pauses", "at least one phone");
    add_words(said, grid, field);
    check_utterance(said);
    return said;
}

}  // namespace viaface
