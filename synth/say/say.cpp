#include "synth/say/say.hpp"

#include <cmath>

#include "base/bytes.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/pose/blinks.hpp"

namespace viaface {
namespace {

// How far drawn points are from commanded ones, over all frames so far.
class Difference {
  public:
    void add(const DrawnFrame& frame) {
        const Configuration apart = frame.drawn - frame.commanded;
        for (int point = 0; point < kPoints; ++point) {
            const double squared = point_of(apart, point).squaredNorm();
            if (std::isnan(squared)) continue;
            sum_ += squared;
            ++count_;
            farthest_ = std::max(farthest_, std::sqrt(squared));
        }
    }
    double rms() const { return count_ == 0 ? 0 : std::sqrt(sum_ / static_cast<double>(count_)); }
    double farthest() const { return farthest_; }

  private:
    double sum_ = 0, farthest_ = 0;
    std::int64_t count_ = 0;
};

template <class T>
std::span<const std::uint8_t> as_bytes(const T* data, std::size_t count) {
    return {reinterpret_cast<const std::uint8_t*>(data), count * sizeof(T)};
}

class Performance {
  public:
    Performance(const SayRequest& request, const Talker& talker, FilmWriter& film, const Onlookers& onlookers)
        : request_(request),
          talker_(talker),
          film_(film),
          onlookers_(onlookers),
          portrait_(talker.face, request.view),
          blinks_(request.seed) {}

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
        report_.rms_mm = difference_.rms();
        report_.farthest_mm = difference_.farthest();
        return report_;
    }

  private:
    void draw_frames(const Recital& recital, std::int64_t first_sample) {
        std::vector<double> times;  // s, from the recital's first sample
        const std::int64_t end = frames_for(report_.samples, report_.sample_rate, request_.fps);
        for (std::int64_t n = report_.frames; n < end; ++n) {
            times.push_back(time_of(n) - static_cast<double>(first_sample) / report_.sample_rate);
        }
        const RowMatrix commanded = recital.motion.at(times);
        for (Eigen::Index row = 0; row < commanded.rows(); ++row) draw(commanded.row(row).transpose());
    }

    void draw(const Configuration& commanded) {
        const double time_s = time_of(report_.frames);
        const double shut = blinks_.amount(time_s);
        const Nodes posed = talker_.poser.posed(commanded, {shut, shut});
        film_.add_frame(portrait_.draw(posed));
        const DrawnFrame frame{report_.frames, time_s, commanded, talker_.poser.drawn_points(posed)};
        difference_.add(frame);
        report_.motion_hash = fnv1a(as_bytes(commanded.data(), kCoordinates), report_.motion_hash);
        if (onlookers_.frame) onlookers_.frame(frame);
        ++report_.frames;
    }

    double time_of(std::int64_t frame) const {
        return static_cast<double>(frame * request_.fps.denominator) / request_.fps.numerator;
    }

    const SayRequest& request_;
    const Talker& talker_;
    FilmWriter& film_;
    const Onlookers& onlookers_;
    Portrait portrait_;
    BlinkSchedule blinks_;
    SayReport report_;
    Difference difference_;
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
