// What encoders of pictures and of sound share. For this folder alone.
#pragma once

#include "synth/film/libav_handles.hpp"

namespace viaface::libav {

using PacketTaker = std::function<void(Handle<AVPacket>)>;

// Not yet opened: one thread, and neither versions nor times in its bytes.
Handle<AVCodecContext> new_encoder(const char* name);

// Gives every packet that the frame completes; nullptr ends the stream and gives the rest.
void encode(AVCodecContext& codec, const AVFrame* frame, const PacketTaker& take);

}  // namespace viaface::libav
