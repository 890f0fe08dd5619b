// How the built-in talker's codex comes about: its corpus is spoken by Flite for the timing (no sound is
// kept), performed by the gestural model, held in a basis chosen by its largest error, analysed into via
// points and cut into units. Motion by a model, not measured.
#pragma once

#include <functional>

#include "synth/learn/codex_learning.hpp"
#include "synth/training/performance.hpp"

namespace viaface {

// The phones of each sentence, then of each string of phones, with Flite's timing.
std::vector<PhoneSequence> timed_corpus(const std::vector<std::string>& sentences,
                                        const std::vector<std::string>& strings);

// The same for any number of threads. `progress` hears what is done, a line at a time.
Codex learn_codex(const Performer& performer, const std::vector<PhoneSequence>& corpus,
                  const std::function<void(const std::string&)>& progress = {},
                  const LearningOptions& options = {});

}  // namespace viaface
