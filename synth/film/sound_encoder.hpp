// 16 bit mono in, packets out, whose stamps count samples of the film's sound. For this folder alone.
#pragma once

#include <cstdint>
#include <span>

#include "synth/film/encoder.hpp"

namespace viaface::libav {

class SoundEncoder {
  public:
    SoundEncoder(const char* name, int rate_in, int rate_out, bool global_header);

    const AVCodecContext& codec() const { return *codec_; }
    std::int64_t samples_in() const { return samples_in_; }

    void add(std::span<const std::int16_t> samples, const PacketTaker& take);
    // Ends after exactly `total` samples of the film's sound, with silence where there is none.
    void end(std::int64_t total, const PacketTaker& take);

  private:
    int block() const;
    void resample(std::span<const std::int16_t> samples);
    Handle<AVFrame> new_block(int samples) const;
    void send(int samples, const PacketTaker& take);

    Handle<AVCodecContext> codec_;
    Handle<SwrContext> resampler_;
    Handle<AVAudioFifo> fifo_;
    std::int64_t samples_in_ = 0, sent_ = 0;
};

}  // namespace viaface::libav
