// Phones asked for one by one, made ready for a synthesiser: words, syllables, and the durations it must
// meet.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "synth/speech/requested_phones.hpp"
#include "synth/speech/utterance.hpp"

namespace viaface {

// Each run between pauses is a word.
bool begins_word(std::span<const RequestedPhone> phones, std::size_t i);
// The word that begins at `first`, as "b-aa-t".
std::string spelt_word(std::span<const RequestedPhone> phones, std::size_t first);
// Consonants go with the vowel after them; those after the last vowel of a word close it.
bool begins_syllable(std::span<const RequestedPhone> phones, std::size_t i);

// Factors on the synthesiser's own durations, [phones], by which `durations_at` (ms, [phones]) meets every
// duration asked for within 0.5 ms. Found by rounds of correction, because a stretch may do less than it
// says. std::runtime_error when rounds do not end.
std::vector<double> stretches_for(
    std::span<const RequestedPhone> phones,
    const std::function<std::vector<double>(std::span<const double> factors)>& durations_at);

// The ends of the phones in s, from the synthesiser's own: those between pauses last as long as asked for.
std::vector<double> ends_asked_for(std::span<const double> own_ends, std::span<const RequestedPhone> phones);

// The utterance with the pauses as long as asked for.
Utterance with_pauses_asked_for(Utterance said, std::span<const RequestedPhone> phones);

}  // namespace viaface
