// A recording whose phones somebody has labelled already.
#pragma once

#include <string>

#include "synth/speech/text_grid.hpp"

namespace viaface {

// How far labels and sound may end apart.
inline constexpr double kLabelsEndApart = 0.050;  // s

// The phones of the tier "phones" on the sound's clock; words are those of the tier "words", or the runs
// between pauses where there is no such tier. The last label ends with the sound. InputError(field, ...) when
// the grid does not fit the sound, has nothing but pauses, or a phone lies in no word.
Utterance labelled(const TextGrid& grid, Waveform sound, const std::string& field);

}  // namespace viaface
