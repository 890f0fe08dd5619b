// How the built-in talker's codex comes about: its corpus is spoken by Flite for the timing (no sound is
// kept), performed by the gestural model, held in a basis chosen by its largest error, analysed into via
// points and cut into units. Motion by a model, not measured.
#pragma once

#include <functional>

#include "synth/training/performance.hpp"
#include "viapoints/codex.hpp"

namespace viaface {

struct LearningOptions {
    double basis_error_mm = 0.1;  // largest, of any point of a configuration that the basis was not made from
    double motion_error_mm = 0.5;  // bound of the via-point analysis, the basis included
};

// The phones of each sentence, then of each string of phones, with Flite's timing.
std::vector<PhoneSequence> timed_corpus(const std::vector<std::string>& sentences,
                                        const std::vector<std::string>& strings);

// The same for any number of threads. `progress` hears what is done, a line at a time.
Codex learn_codex(const Performer& performer, const std::vector<PhoneSequence>& corpus,
                  const std::function<void(const std::string&)>& progress = {},
                  const LearningOptions& options = {});

// What the units hold, and how an unseen text would be spoken from them.
struct Coverage {
    int phones = 0;    // kinds that a unit has as its centre
    int diphones = 0;  // ordered pairs in which a unit follows or leads to its neighbour
    int triphones = 0;
    std::vector<std::string> missing_diphones;  // "b-zh", of all pairs but pau-pau
};
Coverage coverage_of(const Codex& codex);

struct SpokenShares {
    double exact = 0, of_class = 0, half = 0;  // of the slots of all sequences
};
SpokenShares spoken_shares(const Codex& codex, const std::vector<PhoneSequence>& sequences);

}  // namespace viaface
