// A codex out of takes of speech, performed or measured: each is analysed into via points, held in a basis,
// and cut into units (viapoints/codex_cut.hpp). Phones that are outliers stay as context and are never
// spoken.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "viapoints/codex.hpp"

namespace viaface {

// Somebody speaking: phones and motion on one clock.
struct Take {
    std::string name;
    PhoneSequence phones;  // begin and end in a pause
    Motion motion;         // at a fixed rate of at least 50 Hz that covers the phones
};

struct LearningOptions {
    double basis_error_mm = 0.1;  // largest, of any point of a configuration that the basis was not made from
    double motion_error_mm = 0.5;  // bound of the via-point analysis, the basis included
    double shortest_s = 0.014;     // of a phone: the shortest that Flite says are three frames of 5 ms
};

struct LearntCodex {
    Codex codex;
    std::vector<std::string> dropped;  // "a: p at 1.234 s: 0.021 s long, ..."
    double farthest_mm = 0;            // of any point of any take from its spline
};

// Takes are asked for by index, from several threads, and not kept. Motion that holds fewer points than the
// layout gives a codex that holds as many: the talker's face estimates the others when it is drawn.
LearntCodex learn_from_takes(ConfigurationBasis basis, const Configuration& rest, std::size_t takes,
                             const std::function<Take(std::size_t)>& take, std::string provenance,
                             const LearningOptions& options = {});

// One line: recitations, phones, components, via points and how far they miss.
std::string summary(const LearntCodex& learnt);

// What the units hold, and how an unseen text would be spoken from them.
struct Coverage {
    int phones = 0;    // kinds that a unit has as its centre
    int diphones = 0;  // ordered pairs in which a unit follows or leads to its neighbour
    int triphones = 0;
    std::vector<std::string> missing_phones;    // "zh"
    std::vector<std::string> missing_diphones;  // "b-zh", of all pairs but pau-pau
};
Coverage coverage_of(const Codex& codex);

struct SpokenShares {
    double exact = 0, of_class = 0, half = 0;  // of the slots of all sequences
};
SpokenShares spoken_shares(const Codex& codex, const std::vector<PhoneSequence>& sequences);
// Of the codex's own units, if each could be spoken by other recitations only.
SpokenShares shares_by_others(const Codex& codex);

}  // namespace viaface
