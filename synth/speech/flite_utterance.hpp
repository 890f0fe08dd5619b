// An utterance of Flite's as a handle: made, taken through Flite's steps, and what was said read off it.
#pragma once

#include <flite/flite.h>

#include <memory>
#include <string>

#include "synth/speech/prosody.hpp"
#include "synth/speech/utterance.hpp"

namespace viaface {

struct Delete {
    void operator()(cst_utterance* utterance) const { delete_utterance(utterance); }
    void operator()(cst_val* value) const { delete_val(value); }
};
using FliteUtterance = std::unique_ptr<cst_utterance, Delete>;
using FliteValue = std::unique_ptr<cst_val, Delete>;

bool is_statistical(const cst_voice* voice);

// Prosody is set on the utterance, never on the voice that others share.
FliteUtterance new_utterance_of(cst_voice* voice, const Prosody& prosody, const char* text = nullptr);

// A step of Flite. std::runtime_error with Flite's own words when it complains or fails: its complaints go
// nowhere else, and its errors do not end the program.
void run(cst_utterance* utterance, cst_uttfunc step);
// The step that the voice names, or else Flite's own.
void run(cst_utterance* utterance, const char* hook, cst_uttfunc otherwise);

cst_item* segments_of(const cst_utterance* utterance);  // the first of them
double end_of(const cst_item* segment);                 // s

Utterance read_off(cst_utterance* utterance);

}  // namespace viaface
