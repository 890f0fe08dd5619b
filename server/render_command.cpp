#include <cmath>
#include <cstdio>
#include <iostream>

#include "base/error.hpp"
#include "server/commands.hpp"
#include "server/film_output.hpp"
#include "server/motion_options.hpp"
#include "server/requests.hpp"
#include "server/via_models.hpp"
#include "server/view_options.hpp"
#include "synth/film/media_reader.hpp"
#include "synth/render/live_via.hpp"

namespace viaface {
namespace {

struct RenderOptions {
    MotionOptions motion;
    ViewOptions view;
    RenderRequest request;
    std::string audio, talker = kDefaultTalker, output = "motion.mp4", drawn;
    double fps = 30, from = NAN, to = NAN;
    bool quiet = false;
};

// Without sound the film begins with the motion.
double start_of(const RenderOptions& options, const Motion& motion) {
    if (!std::isnan(options.from)) return options.from;
    return options.audio.empty() ? motion.time_s.front() : 0;
}

Sound sound_of(const std::string& file) {
    Sound sound;
    if (file.empty()) return sound;
    sound.samples = read_sound(std::filesystem::path(file), sound.sample_rate);
    if (sound.samples.empty()) throw InputError("--audio", file, "a file with sound in it");
    return sound;
}

// The film, and the points as drawn beside it.
class Output {
  public:
    Output(const RenderOptions& options, int sample_rate)
        : drawn_("--motion", options.drawn), film_(open_output(spec(options, sample_rate), options.output)) {}

    FilmWriter& film() { return *film_; }
    std::function<void(const DrawnFrame&)> onlooker() {
        if (!drawn_.wanted()) return {};
        return [this](const DrawnFrame& frame) { rows_.add(frame.time_s, frame.drawn); };
    }
    void finish() {
        if (drawn_.wanted())
            drawn_.write(rows_.text("points as drawn, read off the posed mesh after contact"));
        drawn_.commit();
    }

  private:
    static FilmSpec spec(const RenderOptions& options, int sample_rate) {
        const View& view = options.request.view;
        return {view.width, view.height, options.request.fps, FilmFormat::kMp4, sample_rate};
    }

    SideFile drawn_;
    MotionRows rows_;
    std::unique_ptr<FilmWriter> film_;
};

RenderReport from_file(RenderOptions& options, const Talker& talker) {
    RenderRequest& request = options.request;
    const MotionInput moving =
        read_motion(options.motion.file, talker, options.motion.parsed(options.talker));
    if (!options.quiet) {
        for (const std::string& line : moving.report) std::fprintf(stderr, "%s\n", line.c_str());
    }
    if (request.keep_head && moving.head.empty())
        throw InputError("--keep-head", "no head motion at hand",
                         "with --head-markers, or for a Live Link Face recording whose head turns");
    const Sound sound = sound_of(options.audio);
    request.from_s = start_of(options, moving.motion);
    if (!std::isnan(options.to)) request.to_s = options.to;
    Output output(options, sound.sample_rate);
    const RenderReport report = render(request, moving, sound, talker, output.film(), output.onlooker());
    output.finish();
    return report;
}

RenderReport from_stdin(const RenderOptions& options, const Talker& talker) {
    if (!options.audio.empty())
        throw InputError("--audio", options.audio, "none while motion is read from stdin");
    Output output(options, Sound{}.sample_rate);
    const auto drawn = [&](auto& rows) {
        return render_live(
            options.request, [&] { return rows.next(); }, talker, output.film(), output.onlooker());
    };
    RenderReport report;
    if (begins_via(std::cin)) {
        const std::vector<StreamModel> models = drawn_stream_models(options.talker);
        std::vector<const StreamModel*> own;
        for (const StreamModel& model : models) own.push_back(&model);
        LiveVia rows(std::cin, own);
        report = drawn(rows);
        std::fputs(rows.describe_damage().c_str(), stderr);
    } else {
        LiveCsv rows(std::cin);
        report = drawn(rows);
    }
    output.finish();
    return report;
}

int run_render(RenderOptions& options) {
    RenderRequest& request = options.request;
    request.view = options.view.parsed();
    request.fps = frame_rate(options.fps);
    const auto talker = talker_at(options.talker);
    const RenderReport report =
        options.motion.file == "-" ? from_stdin(options, *talker) : from_file(options, *talker);
    if (!options.quiet)
        std::fprintf(stderr, "%lld frames; drawn and given points are %.2f mm rms apart, at most %.2f mm\n",
                     static_cast<long long>(report.frames), report.rms_mm, report.farthest_mm);
    return 0;
}

}  // namespace

Command add_render(CLI::App& program) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* app = program.add_subcommand("render",
                                           "A recorded motion in, a video of the talker moving so out; - "
                                           "draws rows of CSV, or a .via stream, from stdin as they come.");
    add_motion_options(*app, options->motion);
    app->add_option("--audio", options->audio,
                    "a sound or video file that began when the motion's clock was 0; no sound when absent");
    app->add_option("-o,--output", options->output,
                    "x.mp4, lossless x.mkv, a folder for PNG files, or - for fragmented MP4 on stdout")
        ->capture_default_str();
    app->add_option(
        "--from", options->from,
        "s of the motion's clock at which the film begins; 0 with sound, else the first sample's");
    app->add_option("--to", options->to,
                    "s of the motion's clock at which it ends; when motion and sound have ended");
    app->add_flag(
        "--keep-head", options->request.keep_head,
        "turn the head in the view as it was turned in the recording (with --head-markers, or as a Live "
        "Link Face recording tells)");
    app->add_option("--talker", options->talker,
                    "a built-in talker's name, or a talker's folder (with a / in it)")
        ->capture_default_str();
    app->add_option("--fps", options->fps, "frames per second, 15 to 120")->capture_default_str();
    add_view_options(*app, options->view);
    app->add_option("--seed", options->request.seed,
                    "of blinks that the motion does not hold, a whole number from 0")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app->add_option("--motion", options->drawn,
                    "write the points as drawn (CSV, mm), read off the posed mesh after contact");
    app->add_flag("--quiet", options->quiet, "no report on stderr");
    return [options] { return run_render(*options); };
}

}  // namespace viaface
