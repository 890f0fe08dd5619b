#include <cstdio>
#include <iostream>

#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "server/recorded_speech.hpp"
#include "synth/speech/text_grid.hpp"

namespace viaface {

Command add_align(CLI::App& program) {
    struct Options {
        RecordedSpeech recorded;
        std::string output = "-";
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "align", "Forced alignment: when a recording says each word and phone of its transcript.");
    app->add_option("audio", options->recorded.audio,
                    "a recording of speech, up to 600 s: WAV, FLAC or another file with sound")
        ->required();
    app->add_option("--transcript", options->recorded.transcript, "its English words, or @FILE");
    app->add_option("--phones", options->recorded.phones,
                    "instead of words: ARPAbet phones, for example \"ax b aa1\"; their durations are found");
    app->add_option("-o,--output", options->output, "a Praat TextGrid; - for stdout")->capture_default_str();
    return [options] {
        const HeardSpeech heard = hear(options->recorded);
        std::fputs(heard.report.c_str(), stderr);
        TextGrid grid;
        append_to(grid, heard.utterance, 0);
        const std::string text = write_text_grid(grid);
        if (options->output == "-") {
            std::cout << text << std::flush;
        } else {
            write_whole(options->output, std::string_view(text));
        }
        return 0;
    };
}

}  // namespace viaface
