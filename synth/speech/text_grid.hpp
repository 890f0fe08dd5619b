// Praat's TextGrid in its long text format, UTF-8: tiers of labelled intervals that cover the whole duration.
// The reader takes the long and the short format alike, as Praat does: numbers, quoted strings and <flags>
// that stand alone count, everything else is decoration. Tiers of points are read over.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "synth/speech/utterance.hpp"

namespace viaface {

struct LabelledInterval {
    double begin = 0, end = 0;  // s
    std::string text;
};

struct IntervalTier {
    std::string name;
    std::vector<LabelledInterval> intervals;
};

struct TextGrid {
    double begin = 0, end = 0;  // s
    std::vector<IntervalTier> tiers;
};

// Numbers are written so that they read back to the same bits.
std::string write_text_grid(const TextGrid& grid);

// InputError("labels", what was met, what is allowed), naming the line.
TextGrid read_text_grid(std::string_view text);

// Adds an utterance whose sound begins at sample `first_sample` of the whole to the tiers "words" and
// "phones" (made when absent): ARPAbet in capitals with stress digits on vowels, "pau" for pauses, "" between
// words.
void append_to(TextGrid& grid, const Utterance& utterance, std::int64_t first_sample);

// The phones of the tier "phones" on a sample clock, times relative to the grid's begin; gaps and empty
// labels are pauses. InputError("labels", ...) when the tier is missing or a label is no phone.
PhoneSequence phones_of(const TextGrid& grid, int sample_rate);

}  // namespace viaface
