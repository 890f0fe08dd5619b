#include "server/recorded_speech.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/align/align.hpp"
#include "synth/align/labelled.hpp"

namespace viaface {
namespace {

constexpr std::size_t kLargestLabels = 64u << 20;

template <class Work>
auto naming(const std::string& option, Work work) {
    try {
        return work();
    } catch (const InputError& error) {
        if (error.field().starts_with("--")) throw;
        throw InputError(option, error.value(), error.allowed());
    }
}

std::string transcript_of(const RecordedSpeech& recorded) {
    if (!recorded.transcript.starts_with('@')) return recorded.transcript;
    return read_text(recorded.transcript.substr(1), "--transcript");
}

std::string report(const Alignment& alignment) {
    char line[160];
    const auto& words = alignment.utterance.words;
    std::snprintf(line, sizeof line, "viaface: aligned %zu words, confidence %.2f\n", words.size(),
                  alignment.confidence);
    std::string text = line;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (alignment.loss[i] < kDoubtfulLoss) continue;
        const double begin = static_cast<double>(words[i].begin) / alignment.utterance.sound.sample_rate;
        std::snprintf(line, sizeof line, "viaface: \"%.40s\" at %.2f s is hardly heard\n",
                      words[i].text.c_str(), begin);
        text += line;
    }
    return text;
}

HeardSpeech aligned(const Recording& recording, const Pronunciation& said, const std::string& option) {
    Alignment alignment = align(recording, said, option);
    std::string lines = report(alignment);
    return {std::move(alignment.utterance), std::move(lines)};
}

}  // namespace

void add_recorded_speech(CLI::App& app, RecordedSpeech& recorded) {
    app.add_option(
        "--audio", recorded.audio,
        "a recording of speech, up to 600 s: WAV, FLAC or another file with sound; channels are mixed");
    app.add_option("--transcript", recorded.transcript, "the English words of --audio, or @FILE");
    app.add_option("--textgrid", recorded.labels,
                   "instead of --transcript: a Praat TextGrid with a tier \"phones\" (ARPAbet)");
}

HeardSpeech hear(const RecordedSpeech& recorded) {
    if (recorded.audio.empty())
        throw InputError("--audio", "", "the recording that is transcribed or labelled");
    const bool transcript = !recorded.transcript.empty(), phones = !recorded.phones.empty();
    if (transcript + phones + !recorded.labels.empty() != 1) {
        throw InputError("--transcript", recorded.transcript,
                         "exactly one of --transcript, --phones and --textgrid with --audio");
    }
    if (transcript) {
        const auto said = naming("--transcript", [&] { return pronounced(transcript_of(recorded)); });
        return aligned(read_recording(recorded.audio, "--audio"), said, "--transcript");
    }
    if (phones) {
        const auto said = naming("--phones", [&] { return pronounced_phones(recorded.phones); });
        return aligned(read_recording(recorded.audio, "--audio"), said, "--phones");
    }
    return naming("--textgrid", [&] {
        const auto grid = read_text_grid(read_text(recorded.labels, "--textgrid", kLargestLabels));
        return HeardSpeech{labelled(grid, read_recording(recorded.audio, "--audio").sound, "--textgrid"), ""};
    });
}

}  // namespace viaface
