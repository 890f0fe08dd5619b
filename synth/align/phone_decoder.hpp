// The likeliest path of a sound through a graph of phones, by PocketSphinx 5prealpha [HugginsDaines06] and
// its US English model (Debian's libpocketsphinx-dev and pocketsphinx-en-us): hidden Markov models of three
// states, scored every 10 ms on windows of 25.625 ms. Only its public interface is used: every arc of the
// graph is a word of one phone in a finite-state grammar. What the model hears of a phone's context is its
// neighbour on the left.
//
// Equal sounds and graphs give equal paths, in any thread: each call has a decoder of its own, and the one
// bit of noise that keeps digital silence apart from log(0) comes from the sample's place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viapoints/phones.hpp"

namespace viaface {

inline constexpr int kDecoderRate = 16000;  // Hz
inline constexpr int kDecoderStep = 160;    // samples from frame to frame
// Where a frame begins on the sound's clock: half a step before the middle of its window. Without this
// boundaries come 7.8 ms early.
inline constexpr int kDecoderDelay = (410 - kDecoderStep) / 2;  // samples

struct PhoneArc {
    int from = 0, to = 0;  // states
    PhoneId phone = kPause;
};

struct PhoneGraph {
    int states = 0;  // the first is the start, the last is the end
    std::vector<PhoneArc> arcs;
    std::vector<std::pair<int, int>> skips;  // from, to: taken without a sound
    double beam = 1e-120;                    // paths less likely than the best by more than this are given up
};

struct HeardPhone {
    int arc = -1;  // index into the graph's arcs; -1 for pauses
    PhoneId phone = kPause;
    int first_frame = 0, frames = 0;
    double score = 0;  // natural logarithm of the likelihood, up to what all phones share
};

// In order, without gaps. Empty when no path leads to the end. std::runtime_error when the model is not
// installed.
std::vector<HeardPhone> likeliest_path(std::span<const std::int16_t> sound, const PhoneGraph& graph);

// The graph in which any phone may follow any other: what the sound would best be without a transcript.
PhoneGraph any_phones();

}  // namespace viaface
