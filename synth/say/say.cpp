#include "synth/say/say.hpp"

#include "base/bytes.hpp"
#include "synth/pose/blinks.hpp"
#include "synth/pose/head_sway.hpp"

namespace viaface {
namespace {

template <class T>
std::span<const std::uint8_t> as_bytes(const T* data, std::size_t count) {
    return {reinterpret_cast<const std::uint8_t*>(data), count * sizeof(T)};
}

class Performance {
  public:
    Performance(const SayRequest& request, const Talker& talker, FilmWriter& film, const Onlookers& onlookers)
        : request_(request),
          film_(film),
          onlookers_(onlookers),
          animation_(talker, request.view, request.fps, film, onlookers.frame,
                     {.renderer = request.renderer}),
          blinks_(request.seed),
          head_sway_(request.head_motion, request.seed) {}

    void perform(const Recital& recital) {
        const Waveform& sound = recital.utterance.sound;
        const std::int64_t first_sample = report_.samples;
        film_.add_sound(sound.samples);
        report_.sample_rate = sound.sample_rate;
        report_.samples += static_cast<std::int64_t>(sound.samples.size());
        report_.sound_hash = fnv1a(as_bytes(sound.samples.data(), sound.samples.size()), report_.sound_hash);
        for (std::size_t level = 0; level < report_.phones_at_level.size(); ++level) {
            report_.phones_at_level[level] += recital.selection.phones_at_level[level];
        }
        if (onlookers_.recital) onlookers_.recital(recital, first_sample);
        draw_frames(recital, first_sample);
    }

    SayReport finish() {
        film_.finish();
        report_.frames = animation_.frames();
        report_.rms_mm = animation_.rms_mm();
        report_.farthest_mm = animation_.farthest_mm();
        report_.motion_hash = animation_.motion_hash();
        return report_;
    }

  private:
    void draw_frames(const Recital& recital, std::int64_t first_sample) {
        std::vector<double> times;  // s, from the recital's first sample
        const std::int64_t end = frames_for(report_.samples, report_.sample_rate, request_.fps);
        for (std::int64_t n = animation_.frames(); n < end; ++n) {
            times.push_back(animation_.time_of(n) - static_cast<double>(first_sample) / report_.sample_rate);
        }
        const RowMatrix commanded = recital.motion.at(times);
        for (Eigen::Index row = 0; row < commanded.rows(); ++row) {
            const double time_s = animation_.time_of(animation_.frames()), shut = blinks_.amount(time_s);
            animation_.draw(commanded.row(row).transpose(), {shut, shut}, head_sway_.at(time_s));
        }
    }

    const SayRequest& request_;
    FilmWriter& film_;
    const Onlookers& onlookers_;
    Animation animation_;
    BlinkSchedule blinks_;
    HeadSway head_sway_;
    SayReport report_;
};

}  // namespace

SayReport say(const SayRequest& request, const Talker& talker, FilmWriter& film, const Onlookers& onlookers) {
    const Script script(request.speech);
    Performance performance(request, talker, film, onlookers);
    for (std::size_t sentence = 0; sentence < script.size(); ++sentence) {
        performance.perform(recite(talker.codex, script.utterance(sentence)));
        if (onlookers.progress)
            onlookers.progress(static_cast<double>(sentence + 1) / static_cast<double>(script.size()));
    }
    return performance.finish();
}

}  // namespace viaface
