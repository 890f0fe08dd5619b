#include <algorithm>
#include <cmath>

#include "synth/film/media_reader.hpp"
#include "synth/film/stream_decoder.hpp"

namespace viaface {
namespace {

using libav::Handle, libav::StreamDecoder;

// Mono floats at the stream's own rate, laid on the time axis by their stamps.
class SoundTimeline {
  public:
    explicit SoundTimeline(const StreamDecoder& decoder) : decoder_(decoder) {}

    int rate() const { return rate_; }
    std::span<const float> samples() const {
        const auto heard = static_cast<std::size_t>(std::max<std::int64_t>(heard_end_, 0));
        return std::span(samples_).first(std::min(heard, samples_.size()));
    }

    void add(const AVFrame& frame) {
        if (rate_ == 0) open(frame);
        if (frame.sample_rate != rate_) decoder_.refuse("sound of one sample rate");
        place(frame, mix(frame));
    }

  private:
    void open(const AVFrame& frame) {
        if (frame.sample_rate <= 0 || frame.sample_rate > kHighestRate) decoder_.refuse();
        rate_ = frame.sample_rate;
        AVChannelLayout mono = AV_CHANNEL_LAYOUT_MONO;
        AVChannelLayout layout = frame.ch_layout;
        SwrContext* mixer = nullptr;
        decoder_.accept(swr_alloc_set_opts2(&mixer, &mono, AV_SAMPLE_FMT_FLT, rate_, &layout,
                                            static_cast<AVSampleFormat>(frame.format), rate_, 0, nullptr));
        mixer_.reset(mixer);
        decoder_.accept(swr_init(mixer_.get()));
        layout_format_ = {frame.ch_layout.nb_channels, frame.format};
    }

    std::vector<float> mix(const AVFrame& frame) {
        if (layout_format_ != std::pair(frame.ch_layout.nb_channels, frame.format)) decoder_.refuse();
        std::vector<float> mono(static_cast<std::size_t>(frame.nb_samples));
        auto* out = reinterpret_cast<std::uint8_t*>(mono.data());
        const auto** in = const_cast<const std::uint8_t**>(frame.extended_data);
        decoder_.accept(swr_convert(mixer_.get(), &out, frame.nb_samples, in, frame.nb_samples));
        return mono;
    }

    // Stamps may be coarse (1 ms in Matroska): sound goes on without a break while they nearly agree.
    void place(const AVFrame& frame, const std::vector<float>& mono) {
        const double here = static_cast<double>(end_) / rate_;
        const std::int64_t stamp = frame.best_effort_timestamp;
        const double asked =
            stamp == AV_NOPTS_VALUE ? here : libav::seconds(stamp, decoder_.stream().time_base);
        if (asked > kLongestMediaSound) decoder_.refuse("sound of at most 30 minutes");
        if (!(std::abs(asked - here) <= kLongestMediaGap)) decoder_.refuse("sound without a gap of a minute");
        if (first_ || std::abs(asked - here) > kCoarse) end_ = std::llround(asked * rate_);
        first_ = false;
        remember_end(frame);
        const std::int64_t count = static_cast<std::int64_t>(mono.size());
        const std::int64_t skipped = std::clamp<std::int64_t>(-end_, 0, count);
        const std::int64_t from = end_ + skipped;
        end_ += count;
        if (end_ <= 0) return;
        samples_.resize(std::max(samples_.size(), static_cast<std::size_t>(end_)));
        std::copy(mono.begin() + skipped, mono.end(), samples_.begin() + from);
    }

    // Encoders fill their last block; the container tells how much of it is to be heard.
    void remember_end(const AVFrame& frame) {
        const std::int64_t ticks = frame.pkt_duration;
        const std::int64_t heard = av_rescale_q(ticks, decoder_.stream().time_base, {1, rate_});
        const bool known = ticks > 0 && heard < frame.nb_samples - kCoarse * rate_;
        heard_end_ = end_ + (known ? heard : frame.nb_samples);
    }

    static constexpr int kHighestRate = 192000;  // Hz
    static constexpr double kCoarse = 0.002;     // s, what stamps may be wrong by

    const StreamDecoder& decoder_;
    Handle<SwrContext> mixer_;
    std::pair<int, int> layout_format_;
    int rate_ = 0;
    bool first_ = true;
    std::int64_t end_ = 0;        // where the next sample goes
    std::int64_t heard_end_ = 0;  // where the last frame falls silent
    std::vector<float> samples_;
};

std::vector<std::int16_t> resampled(std::span<const float> samples, int rate_in, int rate_out) {
    AVChannelLayout mono = AV_CHANNEL_LAYOUT_MONO;
    SwrContext* made = nullptr;
    swr_alloc_set_opts2(&made, &mono, AV_SAMPLE_FMT_S16, rate_out, &mono, AV_SAMPLE_FMT_FLT, rate_in, 0,
                        nullptr);
    const Handle<SwrContext> resampler(made);
    if (!resampler || swr_init(resampler.get()) < 0) throw std::runtime_error("swr_init failed");
    const auto total =
        static_cast<std::size_t>(av_rescale(static_cast<std::int64_t>(samples.size()), rate_out, rate_in));
    std::vector<std::int16_t> out(total);
    std::size_t done = 0;
    const auto convert = [&](const std::uint8_t** in, std::size_t count) {
        auto* to = reinterpret_cast<std::uint8_t*>(out.data() + done);
        const int got =
            swr_convert(resampler.get(), &to, static_cast<int>(total - done), in, static_cast<int>(count));
        if (got < 0) throw std::runtime_error("swr_convert failed");
        done += static_cast<std::size_t>(got);
    };
    constexpr std::size_t kPiece = 1 << 16;
    for (std::size_t at = 0; at < samples.size(); at += kPiece) {
        const auto* in = reinterpret_cast<const std::uint8_t*>(samples.data() + at);
        convert(&in, std::min(kPiece, samples.size() - at));
    }
    if (done < total) convert(nullptr, 0);
    return out;
}

MonoSound read_at(const MediaSource& source, std::optional<int> rate) {
    StreamDecoder decoder(source, AVMEDIA_TYPE_AUDIO);
    if (!decoder.found()) return {};
    SoundTimeline timeline(decoder);
    while (const AVFrame* frame = decoder.next()) timeline.add(*frame);
    if (timeline.rate() == 0) return {};
    const int rate_out = rate.value_or(timeline.rate());
    return {rate_out, resampled(timeline.samples(), timeline.rate(), rate_out)};
}

}  // namespace

MonoSound read_sound(const MediaSource& source) { return read_at(source, std::nullopt); }

std::vector<std::int16_t> read_sound(const MediaSource& source, int rate) {
    return read_at(source, rate).samples;
}

}  // namespace viaface
