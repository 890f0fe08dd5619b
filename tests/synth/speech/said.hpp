// Sentences to be spoken, and whether two utterances are one.
#pragma once

#include <algorithm>

#include "synth/speech/utterance.hpp"

namespace viaface::test {

inline const char* const kSentences[] = {"Once upon a time there was an old man and an old woman.",
                                         "Peter Piper picked a peck of pickled peppers, didn't he?",
                                         "It cost $3.50 in 1984!"};

inline bool same(const Utterance& a, const Utterance& b) {
    if (a.sound.samples != b.sound.samples || a.words.size() != b.words.size()) return false;
    return std::equal(a.phones.phones.begin(), a.phones.phones.end(), b.phones.phones.begin(),
                      b.phones.phones.end(), [](const TimedPhone& p, const TimedPhone& q) {
                          return p.phone == q.phone && p.stress == q.stress && p.begin == q.begin &&
                                 p.end == q.end;
                      });
}

}  // namespace viaface::test
