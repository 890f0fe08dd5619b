#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "server/bench_via.hpp"
#include "server/commands.hpp"
#include "server/request_fields.hpp"
#include "server/requests.hpp"
#include "synth/pose/blinks.hpp"
#include "synth/talker/talker_shelf.hpp"

namespace viaface {
namespace {

constexpr const char* kText = "The old man put five apples in a basket and walked slowly down to the river.";

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Of several times of the same work, which other programs disturb now and then.
struct Times {
    static constexpr int kTimes = 5;
    double middle = 0, least = 0;  // seconds

    explicit Times(const std::function<void()>& work) {
        std::array<double, kTimes> all{};
        for (double& one : all) one = seconds_of(work);
        std::ranges::sort(all);
        middle = all[kTimes / 2], least = all.front();
    }
};

// What the processors have done since the machine started, in ticks: [user, nice, system, idle, iowait, irq,
// softirq, steal], the last for other guests of the same host.
std::array<double, 8> processor_ticks() {
    std::ifstream stat("/proc/stat");
    std::string name;
    std::array<double, 8> ticks{};
    stat >> name;
    for (double& one : ticks) stat >> one;
    return ticks;
}

// Percent of the time since then that the processors were kept from us.
double kept_from_us(const std::array<double, 8>& since) {
    const std::array<double, 8> now = processor_ticks();
    double all = 0;
    for (std::size_t i = 0; i < now.size(); ++i) all += now[i] - since[i];
    return all > 0 ? 100 * (now.back() - since.back()) / all : 0;
}

constexpr double kHeldSeconds = 2;  // of frames: the bench's own memory stays small

void print_heading() { std::printf("%-34s %12s %12s %14s\n", "stage", "ms", "ms a frame", "x real time"); }
void print_stage(const char* name, double seconds, std::size_t frames, double fps) {
    const double count = static_cast<double>(frames);
    std::printf("%-34s %12.2f %12.3f %14.1f\n", name, seconds * 1e3, seconds * 1e3 / count,
                count / fps / seconds);
}
void print_figure(const char* name, double value, const char* unit) {
    std::printf("%-34s %12.2f %s\n", name, value, unit);
}

double peak_resident_mb() {
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0;
    while (status >> word) {
        if (word == "VmHWM:") status >> kilobytes;
    }
    return kilobytes / 1024;
}

FilmSink discarding() {
    return [](std::span<const std::uint8_t>) { return true; };
}

class Bench {
  public:
    Bench(const VideoRequest& request) : request_(request), spec_(film_of(request)) {
        request_.say.speech.text = kText;
    }

    void run() {
        const double loading =
            seconds_of([&] { talker_ = TalkerShelf(talkers_folder()).load(request_.talker); });
        print_heading();
        speak_and_recite();
        pose_and_draw();
        const double encoding = encode_alone();
        whole(encoding);
        print_figure("load the talker, once", loading * 1e3, "ms");
        print_figure("set up the picture, once", setting_up_ * 1e3, "ms");
        print_figure("peak resident set", peak_resident_mb(), "MB");
        if (request_.say.renderer == Renderer::kRaster) draw_with_avx2();
    }

  private:
    double fps() const { return static_cast<double>(spec_.fps.numerator) / spec_.fps.denominator; }
    void print(const char* name, double seconds, std::size_t frames) const {
        print_stage(name, seconds, frames, fps());
    }

    void speak_and_recite() {
        const Script script(request_.say.speech);
        Utterance said;
        const double speaking = seconds_of([&] { said = script.utterance(0); });
        sound_ = said.sound.samples;
        std::optional<Recital> recital;
        const double reciting = seconds_of([&] { recital.emplace(recite(talker_->codex, std::move(said))); });
        const std::int64_t frames =
            frames_for(static_cast<std::int64_t>(sound_.size()), spec_.sample_rate, spec_.fps);
        for (std::int64_t n = 0; n < frames; ++n) {
            times_.push_back(static_cast<double>(n * spec_.fps.denominator) / spec_.fps.numerator);
        }
        const double evaluating = seconds_of([&] { motion_ = recital->motion.at(times_); });
        print("speech", speaking, times_.size());
        print("units, via points, spline", reciting, times_.size());
        print("spline at frame times", evaluating, times_.size());
    }

    std::vector<Nodes> poses() const {
        BlinkSchedule blinks(request_.say.seed);
        std::vector<Nodes> posed;
        posed.reserve(times_.size());
        for (std::size_t n = 0; n < times_.size(); ++n) {
            const double shut = blinks.amount(times_[n]);
            posed.push_back(
                talker_->poser.posed(motion_.row(static_cast<Eigen::Index>(n)).transpose(), {shut, shut}));
        }
        return posed;
    }

    void pose_and_draw() {
        std::vector<Nodes> posed;
        const double posing = seconds_of([&] { posed = poses(); });
        print("pose", posing, times_.size());
        std::optional<Portrait> portrait;
        setting_up_ = seconds_of([&] {
            portrait.emplace(talker_->face, request_.say.view, Drawing{.renderer = request_.say.renderer});
            portrait->draw(posed.front());
        });
        draw(*portrait, posed);
        const auto held = std::min(posed.size(), static_cast<std::size_t>(kHeldSeconds * fps()));
        const std::size_t first = (posed.size() - held) / 2;
        for (std::size_t n = first; n < first + held; ++n) keep(portrait->draw(posed[n]));
    }

    void draw(Portrait& portrait, const std::vector<Nodes>& posed) const {
        const auto before = processor_ticks();
        const Times all([&] {
            for (const Nodes& nodes : posed) portrait.draw(nodes, Portrait::Redraw::kAll);
        });
        print("draw, every frame whole", all.middle, posed.size());
        print("whole, quickest of five times", all.least, posed.size());
        const Times changed = where_moved(portrait, posed);
        print("draw, what moved", changed.middle, posed.size());
        print("what moved, quickest of five times", changed.least, posed.size());
        print_figure("drawn whole / drawn where it moved", all.middle / changed.middle, "times");
        print_figure("processors kept from us meanwhile", kept_from_us(before), "%");
    }

    static Times where_moved(Portrait& portrait, const std::vector<Nodes>& posed) {
        return Times([&] {
            for (const Nodes& nodes : posed) portrait.draw(nodes);
        });
    }

    // As a processor draws that has no wider instructions.
    void draw_with_avx2() const {
        const std::vector<Nodes> posed = poses();
        Portrait portrait(talker_->face, request_.say.view, {.widest = Instructions::kAvx2});
        portrait.draw(posed.front());
        print("draw, what moved, AVX2 at most", where_moved(portrait, posed).middle, posed.size());
    }

    void keep(const FrameView& view) {
        Frame frame{view.width, view.height, {}};
        for (int row = 0; row < view.height; ++row) {
            const std::uint8_t* from = view.top_row + row * view.stride;
            frame.rgba.insert(frame.rgba.end(), from, from + 4 * view.width);
        }
        frames_.push_back(std::move(frame));
    }

    // As many frames as the whole has, from the held ones.
    double encode_alone() {
        const double seconds = seconds_of([&] {
            const auto film = open_film(spec_, discarding());
            film->add_sound(sound_);
            for (std::size_t n = 0; n < times_.size(); ++n) film->add_frame(view(there_and_back(n)));
            film->finish();
        });
        print("encode such frames alone", seconds, times_.size());
        return seconds;
    }

    // Without a jump where the held frames end.
    const Frame& there_and_back(std::size_t n) const {
        const std::size_t last = frames_.size() - 1, at = last == 0 ? 0 : n % (2 * last);
        return frames_[at <= last ? at : 2 * last - at];
    }

    void whole(double encoding) {
        double first_fragment = 0;
        const auto start = std::chrono::steady_clock::now();
        const auto sink = [&](std::span<const std::uint8_t> piece) {
            const std::string_view text(reinterpret_cast<const char*>(piece.data()), piece.size());
            if (first_fragment == 0 && text.find("moof") != std::string_view::npos) {
                first_fragment =
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            }
            return true;
        };
        const double seconds = seconds_of([&] { say(request_.say, *talker_, *open_film(spec_, sink)); });
        print("the whole, streamed", seconds, times_.size());
        print_figure("the whole / encoding alone", seconds / encoding, "times");
        print_figure("first fragment after", first_fragment * 1e3, "ms");
    }

    VideoRequest request_;
    FilmSpec spec_;
    std::shared_ptr<const Talker> talker_;
    double setting_up_ = 0;
    std::vector<std::int16_t> sound_;
    std::vector<double> times_;
    RowMatrix motion_;
    std::vector<Frame> frames_;
};

}  // namespace

Command add_bench(CLI::App& program) {
    struct Options {
        VideoRequest request;
        std::string size = "512x512", renderer = kDefaultRenderer;
        double fps = 30;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "bench",
        "Times the stages on one sentence: real-time factors, and the whole against encoding alone.");
    app->add_option("--talker", options->request.talker, "a built-in talker's name")->capture_default_str();
    app->add_option("--size", options->size, description_of("size"))->capture_default_str();
    app->add_option("--fps", options->fps, description_of("fps"))->capture_default_str();
    app->add_option("--renderer", options->renderer, kRendererHelp)->capture_default_str();
    const Command bench_via = add_bench_via(*app);
    const CLI::App* via = app->get_subcommands({}).back();
    return [options, via, bench_via] {
        if (via->parsed()) return bench_via();
        options->request.say.renderer = renderer_of(options->renderer);
        set_size(options->request.say.view, options->size);
        options->request.say.fps = frame_rate(options->fps);
        check(options->request.say.view);
        validate(film_of(options->request));
        Bench(options->request).run();
        return 0;
    };
}

}  // namespace viaface
