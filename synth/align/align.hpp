// Forced alignment: when a recording says each phone of its transcript. The phones are a chain through which
// the likeliest path is sought (phone_decoder.hpp), with a pause allowed before, between and after words.
//
// A transcript that the recording does not say aligns as well, only badly. So a word's likelihood is set
// against that of the best phones without any transcript over the same time [WittYoung00]:
//   loss = (ln P(any phones) - ln P(transcript)) / frames,
// negative where the transcript is what one would hear. Unsaid is what any phones hear in the transcript's
// pauses within 15 dB of the words' power. The whole's loss is over the words and what is unsaid, and rises
// by 12 (u - 0.1) with the share u of unsaid speech; a tenth is left to breaths. Confidence is
// 1 / (1 + exp(3 (loss - 0.7))); below one half an alignment is refused. Seen: the right words of 30 clips of
// a person and 12 sentences of synthetic voices have 0.58 to 1.00, other sentences' words below 0.5, the same
// without their first third or more mostly too. One word wrong or left out in six is not told by the
// whole; its own loss may tell it.
//
// A recording is aligned whole: time and memory grow with its length, about 0.16 s of a core and 1 MB a
// second.
#pragma once

#include <string>
#include <vector>

#include "synth/align/pronunciation.hpp"
#include "synth/align/recording.hpp"

namespace viaface {

inline constexpr double kLeastConfidence = 0.5;
inline constexpr double kDoubtfulLoss = 2;  // of a word

struct Alignment {
    Utterance utterance;       // on the recording's own sample clock, with its own sound
    std::vector<double> loss;  // [words], nats a frame of 10 ms
    double mean_loss = 0;      // over all speech
    double unsaid = 0;         // share of the speech heard that is outside the words
    double confidence = 0;     // 0 to 1
};

// Whatever the confidence. InputError(field, ...) when the recording is too short for the phones.
Alignment align_anyhow(const Recording& recording, const Pronunciation& said, const std::string& field);

// InputError(field, ...) below kLeastConfidence as well.
Alignment align(const Recording& recording, const Pronunciation& said, const std::string& field);

}  // namespace viaface
