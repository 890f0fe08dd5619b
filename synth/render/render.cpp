#include "synth/render/render.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "synth/pose/blinks.hpp"
#include "viapoints/motion_at.hpp"

namespace viaface {
namespace {

constexpr double kLongestFilm = 7200;  // s
constexpr double kSoundAhead = 0.5;    // s, given to the film before the frames it belongs to

// The lids as they were recorded, or by a schedule.
class Lidding {
  public:
    Lidding(const Motion& motion, std::uint64_t seed)
        : motion_(motion), left_(column("eyeBlink_L")), right_(column("eyeBlink_R")), drawn_(seed) {}

    Blink at(double motion_s, double film_s) {
        if (left_ == nullptr || right_ == nullptr) {
            const double amount = drawn_.amount(film_s);
            return {amount, amount};
        }
        return {shut(*left_, motion_s), shut(*right_, motion_s)};
    }

  private:
    const std::vector<double>* column(const std::string& name) const {
        const auto found = std::ranges::find(motion_.extra, name, &ExtraColumn::name);
        return found == motion_.extra.end() ? nullptr : &found->values;
    }
    double shut(const std::vector<double>& values, double at_s) const {
        const double amount = extra_at(motion_.time_s, values, at_s);
        return std::isnan(amount) ? 0 : std::clamp(amount, 0.0, 1.0);
    }

    const Motion& motion_;
    const std::vector<double>*left_, *right_;
    BlinkSchedule drawn_;
};

Eigen::Isometry3d head_at(const MotionInput& moving, double at_s) {
    const auto [i, s] = between_samples(moving.motion.time_s, at_s);
    if (s == 0) return moving.head[i];
    const Eigen::Isometry3d &here = moving.head[i], &next = moving.head[i + 1];
    Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
    between.linear() =
        Eigen::Quaterniond(here.linear()).slerp(s, Eigen::Quaterniond(next.linear())).toRotationMatrix();
    between.translation() = (1 - s) * here.translation() + s * next.translation();
    return between;
}

// The film's span: frames, and the sound's samples in it.
struct Span {
    std::int64_t frames = 0;
    std::size_t first_sample = 0, samples = 0;
};

Span span_of(const RenderRequest& request, const Motion& motion, const Sound& sound) {
    const double sound_end = static_cast<double>(sound.samples.size()) / sound.sample_rate;
    const double latest = std::max(motion.time_s.back(), sound_end);
    const double end = std::min(request.to_s.value_or(latest), latest);
    const std::string until = std::to_string(latest) + " s, the end of motion and sound";
    if (!(request.from_s >= 0 || request.from_s >= motion.time_s.front()) || !(request.from_s <= latest))
        throw InputError("--from", std::to_string(request.from_s), "a time up to " + until);
    if (!(end >= request.from_s))
        throw InputError("--to", std::to_string(end), "a time behind --from, up to " + until);
    if (end - request.from_s > kLongestFilm)
        throw InputError("--to", std::to_string(end), "a film of at most 7200 s");
    if (motion.time_s.front() > end)
        throw InputError("--from", "motion from " + std::to_string(motion.time_s.front()) + " s on",
                         "a span with motion in it, up to " + until);
    const double rate = static_cast<double>(request.fps.numerator) / request.fps.denominator;
    Span span;
    span.frames = std::max<std::int64_t>(1, std::llround(std::ceil((end - request.from_s) * rate - 1e-6)));
    const auto sample_at = [&](double time_s) {
        return static_cast<std::size_t>(std::llround(std::clamp(time_s, 0.0, sound_end) * sound.sample_rate));
    };
    span.first_sample = sample_at(request.from_s);
    span.samples = sample_at(end) - span.first_sample;
    span.frames = std::max(
        span.frames, frames_for(static_cast<std::int64_t>(span.samples), sound.sample_rate, request.fps));
    return span;
}

// Gives the film its sound, ahead of the frames.
class SoundFeed {
  public:
    SoundFeed(const Sound& sound, const Span& span, FilmWriter& film)
        : rate_(sound.sample_rate),
          left_(std::span(sound.samples).subspan(span.first_sample, span.samples)),
          film_(film) {}

    void up_to(double film_s) {
        const auto wanted = static_cast<std::size_t>(std::max(0.0, (film_s + kSoundAhead) * rate_));
        if (wanted <= given_ || left_.empty()) return;
        const auto some = left_.first(std::min(left_.size(), wanted - given_));
        film_.add_sound(some);
        left_ = left_.subspan(some.size());
        given_ += some.size();
    }

  private:
    int rate_;
    std::span<const std::int16_t> left_;
    FilmWriter& film_;
    std::size_t given_ = 0;
};

}  // namespace

RenderReport render(const RenderRequest& request, const MotionInput& moving, const Sound& sound,
                    const Talker& talker, FilmWriter& film,
                    const std::function<void(const DrawnFrame&)>& onlooker) {
    const Span span = span_of(request, moving.motion, sound);
    Animation animation(talker, request.view, request.fps, film, onlooker, request.drawing);
    Lidding lids(moving.motion, request.seed);
    SoundFeed feed(sound, span, film);
    const bool turns = request.keep_head && !moving.head.empty();
    while (animation.frames() < span.frames) {
        const double film_s = animation.time_of(animation.frames()), motion_s = request.from_s + film_s;
        feed.up_to(film_s);
        const Configuration points = motion_at(moving.motion, motion_s);
        if (points.array().isNaN().all())
            throw InputError("motion", "no point at " + std::to_string(motion_s) + " s",
                             "at least one point at every time");
        const auto head = turns ? head_at(moving, motion_s) : Eigen::Isometry3d::Identity();
        animation.draw(points, lids.at(motion_s, film_s), head);
    }
    film.finish();
    return {animation.frames(), animation.rms_mm(), animation.farthest_mm(), animation.motion_hash()};
}

}  // namespace viaface
