#include "synth/film/encoder.hpp"

namespace viaface::libav {

Handle<AVCodecContext> new_encoder(const char* name) {
    const AVCodec* codec = avcodec_find_encoder_by_name(name);
    if (!codec) throw std::runtime_error(std::string("libavcodec has no encoder ") + name);
    auto context = made(avcodec_alloc_context3(codec), "avcodec_alloc_context3");
    context->flags |= AV_CODEC_FLAG_BITEXACT;
    context->thread_count = 1;
    return context;
}

void encode(AVCodecContext& codec, const AVFrame* frame, const PacketTaker& take) {
    check(avcodec_send_frame(&codec, frame), "encoding");
    while (true) {
        auto packet = made(av_packet_alloc(), "av_packet_alloc");
        const int code = avcodec_receive_packet(&codec, packet.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
        check(code, "encoding");
        take(std::move(packet));
    }
}

}  // namespace viaface::libav
