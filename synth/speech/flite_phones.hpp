// Requested phones as an utterance of Flite's that was never text: the relations that its text analysis would
// have made, and durations met by stretching (statistical voices) or set (diphones).
#pragma once

#include <span>

#include "synth/speech/flite_utterance.hpp"
#include "synth/speech/requested_phones.hpp"

namespace viaface {

FliteUtterance spoken_by_flite(cst_voice* voice, std::span<const RequestedPhone> phones,
                               const Prosody& prosody);

}  // namespace viaface
