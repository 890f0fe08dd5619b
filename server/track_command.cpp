#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "server/film_output.hpp"
#include "server/requests.hpp"
#include "synth/lips/learned_lips.hpp"
#include "synth/track/film_track.hpp"
#include "synth/track/overlay.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

struct TrackOptions {
    TrackRequest request;
    std::string output, overlay, lips, hint, talker = kDefaultTalker;
    int modes = kMostModes;
    bool quiet = false;

    static constexpr int kMostModes = 10;
};

LipModel model_of(const TrackOptions& options) {
    if (!options.lips.empty()) return with_modes(load_lip_model(options.lips), options.modes);
    const Talker talker = load_talker(talker_folder(options.talker), Textures::kLeft);
    LipModel model = learn_from(recited_lip_frames(talker), {.modes = options.modes}, {});
    model.provenance = "the recitations of the talker " + talker.name();
    return model;
}

// The film again with the lips drawn over it, and its sound.
class Overlay {
  public:
    Overlay(const std::string& output, const std::filesystem::path& video)
        : output_(output), fps_(rate_of(video)), sound_(read_sound(video, kRate)) {}

    void add(const TimedFrame& timed, const TrackedLips& lips) {
        Frame frame = timed.frame;
        draw_lips(frame, lips);
        if (!film_)
            film_ = open_output({frame.width / 2 * 2, frame.height / 2 * 2, fps_, {}, kRate}, output_);
        const auto end = std::min<std::size_t>(sound_.size(), samples_for(++frames_, kRate, fps_));
        film_->add_sound(std::span(sound_).subspan(heard_, end - heard_));
        heard_ = end;
        film_->add_frame(
            {frame.width / 2 * 2, frame.height / 2 * 2, frame.rgba.data(), std::ptrdiff_t{4} * frame.width});
    }
    void finish() { film_->finish(); }

  private:
    static constexpr int kRate = 48000;

    static FrameRate rate_of(const std::filesystem::path& video) {
        const double fps = FrameReader(video).frames_per_s();
        try {
            return frame_rate(fps);
        } catch (const InputError&) {
            throw InputError("--overlay", std::to_string(fps) + " frames per second", "a film of 15 to 120");
        }
    }

    std::string output_;
    FrameRate fps_;
    std::vector<std::int16_t> sound_;
    std::unique_ptr<FilmWriter> film_;
    std::int64_t frames_ = 0;
    std::size_t heard_ = 0;
};

int run_track(TrackOptions& options) {
    if (!options.hint.empty()) options.request.hint = parse_hint(read_text(options.hint, "--hint", 1u << 16));
    const LipModel model = model_of(options);
    std::optional<Overlay> overlay;
    if (!options.overlay.empty()) overlay.emplace(options.overlay, options.request.video);
    TrackOnlooker onlooker;
    if (overlay)
        onlooker = [&](const TimedFrame& frame, const TrackedLips& lips) { overlay->add(frame, lips); };
    FilmTrack track = track_film(model, options.request, onlooker);
    track.comments.push_back("lip model: " + model.provenance);
    write_motion_csv(options.output, track.motion, track.comments);
    if (overlay) overlay->finish();
    for (const std::string& line : track.report) {
        if (!options.quiet) std::fprintf(stderr, "%s\n", line.c_str());
    }
    return 0;
}

}  // namespace

Command add_track(CLI::App& program) {
    auto options = std::make_shared<TrackOptions>();
    CLI::App* app = program.add_subcommand("track", "Lips tracked in a video, as motion of their points.");
    app->add_option("video", options->request.video, "a video of an upright face, seen from the front")
        ->required();
    app->add_option("-o,--output", options->output, "motion CSV to write")->required();
    app->add_option("--overlay", options->overlay,
                    "x.mp4, lossless x.mkv or a folder for PNG files: the video with the lips drawn over it");
    app->add_option("--lips", options->lips,
                    "a lip model as `viaface lips train` writes it; the talker's recitations when absent");
    app->add_option("--talker", options->talker,
                    "whose recitations the lips are learned from: a name, or a folder (with a / in it)")
        ->capture_default_str();
    app->add_option("--modes", options->modes, "modes to use, 1 to 48: few are robust, many accurate")
        ->check(CLI::Range(1, 48))
        ->capture_default_str();
    app->add_option("--scale-mm", options->request.eye_distance_mm,
                    "distance of the talker's pupils, 40 to 90 mm: what millimetres rest on")
        ->check(CLI::Range(40.0, 90.0))
        ->capture_default_str();
    app->add_option("--hint", options->hint,
                    "JSON with the places of eyes and mouth in the first picture, where they are not found: "
                    "{\"eyes\": [[u, v], [u, v]], \"mouth\": [u, v, width, height]}, px");
    app->add_flag("--quiet", options->quiet, "no report on stderr");
    return [options] { return run_track(*options); };
}

}  // namespace viaface
