// What every use of libav shares: owners of its objects, and errors, which are thrown and never printed. For
// this folder alone.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavcodec/bsf.h>
#include <libavformat/avformat.h>
#include <libavutil/audio_fifo.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viaface::libav {

struct Free {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVBSFContext* filter) const { av_bsf_free(&filter); }
    void operator()(AVFormatContext* format) const;  // one that reads or one that writes
    void operator()(AVIOContext* io) const;          // one with a buffer of its own, and no file
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
    void operator()(SwrContext* resampler) const { swr_free(&resampler); }
    void operator()(AVAudioFifo* fifo) const { av_audio_fifo_free(fifo); }
};
template <class T>
using Handle = std::unique_ptr<T, Free>;

// A handle of what was allocated; std::runtime_error naming what failed when there is nothing.
template <class T>
Handle<T> made(T* handle, const char* what) {
    if (!handle) throw std::runtime_error(std::string(what) + " failed");
    return Handle<T>(handle);
}

// The code when it is no error, else std::runtime_error with libav's word for it.
int check(int code, const char* what);

using Options = std::vector<std::pair<const char*, std::string>>;

// Every option must be known to what `open` opens: one that is left over is an error, not ignored.
void with_options(const Options& options, const char* what, const std::function<int(AVDictionary**)>& open);

}  // namespace viaface::libav
