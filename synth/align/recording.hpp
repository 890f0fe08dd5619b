// A recording as it is heard: its sound at its own rate, and at the rate that the aligner listens at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "synth/speech/utterance.hpp"

namespace viaface {

inline constexpr double kLongestRecording = 600;  // s

struct Recording {
    Waveform sound;                       // mono: channels are mixed
    std::vector<std::int16_t> at_16_khz;  // the same
};

// WAV, FLAC or whatever else libav reads. InputError(field, ...) when the file holds no sound, silence, or
// more than kLongestRecording of it.
Recording read_recording(const std::filesystem::path& file, const std::string& field);

// A sound that is at 16 kHz already.
Recording recording_of(Waveform sound);

}  // namespace viaface
