// What a synthesiser tells about each phone that it spoke, and the Utterance they make.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "synth/speech/utterance.hpp"

namespace viaface {

inline constexpr double kLeadIn = 0.15, kLeadOut = 0.25;  // s, the pauses around a sentence

struct SpokenPhone {
    std::string name;                 // as parse_phone() reads it
    double end_s = 0;                 // of the phone
    bool in_word = false;             // else a pause, or silence without a name
    std::string stress;               // of its syllable: "1", "2" or anything else
    std::optional<std::string> word;  // the word that begins here
};

// Neighbouring pauses become one. Waves end some ms before the last phone does, or in the middle of the last
// pause: the phones decide where the sound ends.
Utterance utterance_of(std::span<const SpokenPhone> spoken, Waveform sound);

// The utterance with pauses of kLeadIn and kLeadOut around it.
Utterance with_edges(Utterance said);

}  // namespace viaface
