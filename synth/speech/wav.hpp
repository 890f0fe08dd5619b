// WAV files of one channel of 16-bit PCM.
#pragma once

#include <span>

#include "base/bytes.hpp"
#include "synth/speech/utterance.hpp"

namespace viaface {

Bytes write_wav(const Waveform& sound);

// InputError("sound", what was met, what is allowed). Chunks other than fmt and data are read over.
Waveform read_wav(std::span<const std::uint8_t> bytes);

}  // namespace viaface
