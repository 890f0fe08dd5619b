// What a recording is said to hold, as words and phones without times.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viapoints/phones.hpp"

namespace viaface {

struct Pronunciation {
    std::vector<std::string> words;     // as spoken: "42" is the two words "forty" and "two"
    std::vector<StressedPhone> phones;  // without pauses
    std::vector<int> word_of_phone;     // [phones], index into words, rising
};

// A transcript as Flite would read it aloud: its lexicon, and its letter-to-sound rules for words outside it.
// InputError("text", ...) as sentences() of synth/speech/text.hpp throws it.
Pronunciation pronounced(std::string_view transcript);

// Phones as parse_phones() reads them, durations without effect; each run between pauses is a word.
Pronunciation pronounced_phones(std::string_view phones);

}  // namespace viaface
