// What was said: words, phones and the sound, all on the sample clock of the sound.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viapoints/phones.hpp"

namespace viaface {

struct Waveform {
    int sample_rate = 16000;            // Hz
    std::vector<std::int16_t> samples;  // mono

    double seconds() const { return static_cast<double>(samples.size()) / sample_rate; }
};

struct Word {
    std::string text;                 // as spoken: "42" is the two words "forty" and "two"
    std::int64_t begin = 0, end = 0;  // samples, [begin, end)
};

// The phones are gapless, start at sample 0 and end with the last sample; the first and the last are pauses,
// no two pauses are neighbours, and a word covers exactly its phones.
struct Utterance {
    std::vector<Word> words;
    PhoneSequence phones;
    std::vector<int> word_of_phone;  // [phones], index into words; -1 for pauses
    Waveform sound;
};

// std::logic_error naming the first thing that is broken.
void check_utterance(const Utterance& utterance);

// The pause at `phone` made `length` samples long: silence is put in or cut out, at the outer edge of a first
// or last pause and in the middle of any other; all that follows moves along. What is left of the pause fades
// towards the cut over at most 2.5 ms.
Utterance with_pause_length(Utterance utterance, std::size_t phone, std::int64_t length);

}  // namespace viaface
