#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "server/commands.hpp"
#include "server/film_output.hpp"
#include "server/recorded_speech.hpp"
#include "server/request_fields.hpp"
#include "server/requests.hpp"
#include "server/view_options.hpp"
#include "synth/say/report_json.hpp"
#include "synth/speech/text_grid.hpp"

namespace viaface {
namespace {

struct SayOptions {
    VideoRequest request;
    ViewOptions view;
    std::string output = "talk.mp4", renderer = kDefaultRenderer;
    double fps = 30;
    std::string labels, motion, commanded, json;
    RecordedSpeech recorded;
    bool quiet = false;
};

std::unique_ptr<FilmWriter> film_for(const SayOptions& options) {
    FilmSpec spec = film_of(options.request);
    if (const auto& recorded = options.request.say.speech.recorded) {
        spec.sample_rate = recorded->sound.sample_rate;
    }
    return open_output(spec, options.output);
}

// What goes beside the film.
class SideFiles {
  public:
    explicit SideFiles(const SayOptions& options)
        : options_(options),
          labels_("--labels", options.labels),
          motion_("--motion", options.motion),
          commanded_("--commanded", options.commanded),
          json_("--json", options.json == "-" ? "" : options.json) {}

    void add(const DrawnFrame& frame) {
        if (motion_.wanted()) drawn_rows_.add(frame.time_s, frame.drawn);
        if (commanded_.wanted()) commanded_rows_.add(frame.time_s, frame.commanded);
    }

    void add(const Recital& recital, std::int64_t first_sample) {
        timeline_.add(recital, first_sample);
        append_to(grid_, recital.utterance, first_sample);
    }

    void write(const SayReport& report) {
        if (labels_.wanted()) labels_.write(write_text_grid(grid_));
        if (motion_.wanted())
            motion_.write(drawn_rows_.text("points as drawn, read off the posed mesh after contact"));
        if (commanded_.wanted()) commanded_.write(commanded_rows_.text("points as commanded by the spline"));
        if (!options_.json.empty()) write_report(report);
        for (SideFile* file : {&labels_, &motion_, &commanded_, &json_}) file->commit();
    }

  private:
    void write_report(const SayReport& report) {
        const auto json = report_json(options_.request.say, options_.request.talker, timeline_, report);
        const std::string text = json.dump(2) + "\n";
        if (json_.wanted()) {
            json_.write(text);
        } else {
            std::cout << text << std::flush;
        }
    }

    const SayOptions& options_;
    SideFile labels_, motion_, commanded_, json_;
    MotionRows drawn_rows_, commanded_rows_;
    Timeline timeline_;
    TextGrid grid_;
};

void show_progress(double share) {
    std::fprintf(stderr, "\rviaface: %3.0f%% drawn%s", std::floor(share * 100), share >= 1 ? "\n" : "");
}

// Every result has a place of its own.
void check_places(const SayOptions& options) {
    if (options.output == "-" && options.json == "-") {
        throw InputError("--json", "-", "a file, when the film goes to stdout");
    }
    std::set<std::string> taken{options.output};
    const std::pair<const char*, const std::string&> side_files[] = {{"--labels", options.labels},
                                                                     {"--motion", options.motion},
                                                                     {"--commanded", options.commanded},
                                                                     {"--json", options.json}};
    for (const auto& [option, path] : side_files) {
        if (!path.empty() && !taken.insert(path).second)
            throw InputError(option, path, "a file that nothing else is written to");
    }
}

// With --audio the recording is what is said.
void listen(SayOptions& options) {
    SpeechRequest& speech = options.request.say.speech;
    RecordedSpeech recorded = options.recorded;
    if (recorded.audio.empty() && recorded.transcript.empty() && recorded.labels.empty()) return;
    if (!speech.text.empty()) {
        throw InputError("text", speech.text,
                         "no text when --audio is given: its words are its --transcript");
    }
    recorded.phones = std::exchange(speech.phones, "");
    const HeardSpeech heard = hear(recorded);
    if (!options.quiet) std::fputs(heard.report.c_str(), stderr);
    speech.recorded = std::make_shared<const Utterance>(heard.utterance);
}

void complete(SayOptions& options) {
    SayRequest& say_request = options.request.say;
    say_request.view = options.view.parsed();
    say_request.fps = frame_rate(options.fps);
    say_request.renderer = renderer_of(options.renderer);
    if (options.output != "-") options.request.format = film_format_of(options.output);
    check_places(options);
    if (say_request.speech.text == "-") {
        say_request.speech.text.assign(std::istreambuf_iterator<char>(std::cin), {});
    }
    listen(options);
}

int run_say(SayOptions& options) {
    complete(options);
    const auto talker = talker_at(options.request.talker);
    settle_voice(options.request, *talker);
    const Script checked(options.request.say.speech);
    SideFiles beside(options);
    const auto film = film_for(options);
    Onlookers onlookers;
    onlookers.frame = [&](const DrawnFrame& frame) { beside.add(frame); };
    onlookers.recital = [&](const Recital& recital, std::int64_t first_sample) {
        beside.add(recital, first_sample);
    };
    if (!options.quiet && isatty(STDERR_FILENO) != 0) onlookers.progress = show_progress;
    const SayReport report = say(options.request.say, *talker, *film, onlookers);
    beside.write(report);
    return 0;
}

}  // namespace

Command add_say(CLI::App& program) {
    auto options = std::make_shared<SayOptions>();
    CLI::App* app = program.add_subcommand("say", "Text in, a talking-face video out.");
    SpeechRequest& speech = options->request.say.speech;
    app->add_option("text", speech.text, description_of("text") + "; - reads it from stdin");
    app->add_option("--phones", speech.phones, description_of("phones"));
    add_recorded_speech(*app, options->recorded);
    app->add_option("-o,--output", options->output,
                    "x.mp4, lossless x.mkv, a folder for PNG files, or - for fragmented MP4 on stdout")
        ->capture_default_str();
    app->add_option("--voice", options->request.voice, description_of("voice"));
    app->add_option("--rate", speech.prosody.rate, description_of("rate"))->capture_default_str();
    app->add_option("--pitch", speech.prosody.pitch, description_of("pitch"))->capture_default_str();
    app->add_option("--talker", options->request.talker,
                    "a built-in talker's name, or a talker's folder (with a / in it)")
        ->capture_default_str();
    app->add_option("--fps", options->fps, description_of("fps"))->capture_default_str();
    add_view_options(*app, options->view);
    app->add_option("--renderer", options->renderer, kRendererHelp)->capture_default_str();
    app->add_option("--head-motion", options->request.say.head_motion,
                    "degrees that the head turns by itself, 0 to 10; the eyes stay on the viewer")
        ->capture_default_str();
    app->add_option("--seed", options->request.say.seed, description_of("seed"))
        ->check([](const std::string& given) {  // the library takes "-1" for 2^64 - 1
            return given.starts_with('-') ? "--seed: " + given + " is below 0" : "";
        })
        ->capture_default_str();
    app->add_option("--labels", options->labels, "write words and phones as a Praat TextGrid");
    app->add_option("--motion", options->motion,
                    "write the points as drawn (CSV, mm), read off the posed mesh after contact");
    app->add_option("--commanded", options->commanded,
                    "write the points as commanded by the spline (CSV, mm)");
    app->add_option(
        "--json", options->json,
        "write a report: timeline, durations, units used, drawn against commanded, hashes; - for stdout");
    app->add_flag("--quiet", options->quiet, "no progress on stderr");
    return [options] { return run_say(*options); };
}

}  // namespace viaface
