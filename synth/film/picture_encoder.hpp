// Pictures in, packets out, whose stamps count frames. For this folder alone.
#pragma once

#include <cstdint>

#include "synth/film/encoder.hpp"
#include "synth/film/film_spec.hpp"
#include "synth/film/frame.hpp"

namespace viaface::libav {

struct PictureRecipe {
    const char* codec;
    AVPixelFormat pixels;
    Options options;
    bool bt709 = false;
};

PictureRecipe h264(bool streamed);  // streamed: no B-frames, no look-ahead
PictureRecipe ffv1();
PictureRecipe png();

class PictureEncoder {
  public:
    PictureEncoder(const FilmSpec& spec, const PictureRecipe& recipe, bool global_header);

    const AVCodecContext& codec() const { return *codec_; }
    std::int64_t frames() const { return frames_; }

    // std::invalid_argument when the view has not the size of the film.
    void add(const FrameView& view, const PacketTaker& take);
    void end(const PacketTaker& take) { encode(*codec_, nullptr, take); }

  private:
    void tag_bt709();
    void open_scaler(bool bt709);
    void convert(const FrameView& view);

    Handle<AVCodecContext> codec_;
    Handle<SwsContext> scaler_;
    Handle<AVFrame> picture_;
    std::int64_t frames_ = 0;
};

// x264 writes its version and settings into SEI units before the first frame.
class SeiRemover {
  public:
    explicit SeiRemover(const AVCodecContext& codec);
    Handle<AVPacket> clean(Handle<AVPacket> packet);

  private:
    Handle<AVBSFContext> filter_;
};

}  // namespace viaface::libav
