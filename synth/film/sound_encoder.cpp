#include "synth/film/sound_encoder.hpp"

extern "C" {
#include <libavutil/channel_layout.h>
}

#include <algorithm>

namespace viaface::libav {
namespace {

constexpr int kPcmBlock = 1024;  // samples a packet
constexpr int kBitRate = 96000;  // of what is not PCM

}  // namespace

SoundEncoder::SoundEncoder(const char* name, int rate_in, int rate_out, bool global_header)
    : codec_(new_encoder(name)) {
    codec_->sample_fmt = codec_->codec->sample_fmts[0];
    codec_->sample_rate = rate_out;
    codec_->time_base = {1, rate_out};
    codec_->bit_rate = kBitRate;
    av_channel_layout_default(&codec_->ch_layout, 1);
    if (global_header) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    check(avcodec_open2(codec_.get(), nullptr, nullptr), "opening the sound encoder");
    SwrContext* resampler = nullptr;
    check(swr_alloc_set_opts2(&resampler, &codec_->ch_layout, codec_->sample_fmt, rate_out,
                              &codec_->ch_layout, AV_SAMPLE_FMT_S16, rate_in, 0, nullptr),
          "swr_alloc_set_opts2");
    resampler_ = made(resampler, "swr_alloc_set_opts2");
    check(swr_init(resampler_.get()), "swr_init");
    fifo_ = made(av_audio_fifo_alloc(codec_->sample_fmt, 1, block()), "av_audio_fifo_alloc");
}

void SoundEncoder::add(std::span<const std::int16_t> samples, const PacketTaker& take) {
    constexpr std::size_t kPiece = 1 << 16;  // samples resampled at a time
    for (; !samples.empty(); samples = samples.subspan(std::min(kPiece, samples.size()))) {
        resample(samples.first(std::min(kPiece, samples.size())));
        while (av_audio_fifo_size(fifo_.get()) >= block()) send(block(), take);
    }
}

void SoundEncoder::end(std::int64_t total, const PacketTaker& take) {
    resample({});
    while (sent_ < total) send(static_cast<int>(std::min<std::int64_t>(block(), total - sent_)), take);
    encode(*codec_, nullptr, take);
}

int SoundEncoder::block() const { return codec_->frame_size > 0 ? codec_->frame_size : kPcmBlock; }

void SoundEncoder::resample(std::span<const std::int16_t> samples) {
    samples_in_ += static_cast<std::int64_t>(samples.size());
    const int count = static_cast<int>(samples.size());
    const auto out =
        new_block(check(swr_get_out_samples(resampler_.get(), count), "swr_get_out_samples") + 1);
    const auto* in = reinterpret_cast<const std::uint8_t*>(samples.data());
    const int got =
        check(swr_convert(resampler_.get(), out->data, out->nb_samples, count > 0 ? &in : nullptr, count),
              "swr_convert");
    check(av_audio_fifo_write(fifo_.get(), reinterpret_cast<void**>(out->data), got), "av_audio_fifo_write");
}

Handle<AVFrame> SoundEncoder::new_block(int samples) const {
    auto frame = made(av_frame_alloc(), "av_frame_alloc");
    frame->nb_samples = samples;
    frame->format = codec_->sample_fmt;
    frame->sample_rate = codec_->sample_rate;
    check(av_channel_layout_copy(&frame->ch_layout, &codec_->ch_layout), "av_channel_layout_copy");
    check(av_frame_get_buffer(frame.get(), 0), "av_frame_get_buffer");
    return frame;
}

void SoundEncoder::send(int samples, const PacketTaker& take) {
    const auto frame = new_block(samples);
    const int got = check(av_audio_fifo_read(fifo_.get(), reinterpret_cast<void**>(frame->data), samples),
                          "av_audio_fifo_read");
    check(av_samples_set_silence(frame->data, got, samples - got, 1, codec_->sample_fmt), "silence");
    frame->pts = sent_;
    sent_ += samples;
    encode(*codec_, frame.get(), take);
}

}  // namespace viaface::libav
