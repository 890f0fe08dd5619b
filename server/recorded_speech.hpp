// Speech that a person recorded, as options of the command line name it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "synth/speech/utterance.hpp"

namespace viaface {

struct RecordedSpeech {
    std::string audio;       // file
    std::string transcript;  // text, or @FILE
    std::string labels;      // TextGrid file
    std::string phones;      // as parse_phones() reads them
};

// --audio, --transcript and --textgrid.
void add_recorded_speech(CLI::App& app, RecordedSpeech& recorded);

struct HeardSpeech {
    Utterance utterance;
    std::string report;  // lines for stderr: confidence, and the words that are doubtful
};

// Labelled by the TextGrid, or aligned with the transcript or the phones: exactly one of the three is given.
// InputError naming the option.
HeardSpeech hear(const RecordedSpeech& recorded);

}  // namespace viaface
