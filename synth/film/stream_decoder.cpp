#include "synth/film/stream_decoder.hpp"

#include <algorithm>
#include <cstring>

#include "base/error.hpp"

namespace viaface::libav {
namespace {

std::string name_of(const MediaSource& source) {
    if (const auto* path = std::get_if<std::filesystem::path>(&source)) return path->string();
    return std::to_string(std::get<std::span<const std::uint8_t>>(source).size()) + " bytes";
}

}  // namespace

int MemoryFile::read(void* self, std::uint8_t* to, int size) {
    auto& file = *static_cast<MemoryFile*>(self);
    const std::int64_t left = static_cast<std::int64_t>(file.bytes.size()) - file.at;
    if (left <= 0) return AVERROR_EOF;
    const int count = static_cast<int>(std::min<std::int64_t>(size, left));
    std::memcpy(to, file.bytes.data() + file.at, static_cast<std::size_t>(count));
    file.at += count;
    return count;
}

std::int64_t MemoryFile::seek(void* self, std::int64_t offset, int whence) {
    auto& file = *static_cast<MemoryFile*>(self);
    const auto size = static_cast<std::int64_t>(file.bytes.size());
    if (whence == AVSEEK_SIZE) return size;
    const std::int64_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : size;
    if (offset < -from || offset > size - from) return AVERROR(EINVAL);
    return file.at = from + offset;
}

StreamDecoder::StreamDecoder(const MediaSource& source, AVMediaType kind) : name_(name_of(source)) {
    open(source);
    accept(avformat_find_stream_info(format_.get(), nullptr));
    const AVCodec* codec = nullptr;
    index_ = av_find_best_stream(format_.get(), kind, -1, -1, &codec, 0);
    if (index_ == AVERROR_STREAM_NOT_FOUND) return;
    accept(index_);
    open_codec(codec);
}

const AVFrame* StreamDecoder::next() {
    while (true) {
        const int code = avcodec_receive_frame(codec_.get(), frame_.get());
        if (code == AVERROR_EOF) return nullptr;
        if (code != AVERROR(EAGAIN)) {
            accept(code);
            ++decoded_;
            return frame_.get();
        }
        feed();
    }
}

int StreamDecoder::accept(int code) const {
    if (code < 0) refuse();
    return code;
}

void StreamDecoder::refuse(const char* allowed) const {
    const std::string where =
        decoded_ > 0 ? ", damaged or cut after " + std::to_string(decoded_) + " frames" : "";
    throw InputError("media", name_ + where, allowed);
}

void StreamDecoder::open(const MediaSource& source) {
    AVFormatContext* format = avformat_alloc_context();
    if (!format) throw std::bad_alloc();
    std::string url;
    if (const auto* bytes = std::get_if<std::span<const std::uint8_t>>(&source)) {
        memory_.bytes = *bytes;
        constexpr int kBuffer = 1 << 16;
        io_.reset(avio_alloc_context(static_cast<std::uint8_t*>(av_malloc(kBuffer)), kBuffer, 0, &memory_,
                                     &MemoryFile::read, nullptr, &MemoryFile::seek));
        format->pb = io_.get();
    } else {
        url = "file:" + std::get<std::filesystem::path>(source).string();
    }
    format->protocol_whitelist = av_strdup("file");  // a playlist must not reach the network
    accept(avformat_open_input(&format, url.c_str(), nullptr, nullptr));
    format_.reset(format);
}

void StreamDecoder::open_codec(const AVCodec* codec) {
    codec_.reset(avcodec_alloc_context3(codec));
    if (!codec_) throw std::bad_alloc();
    accept(avcodec_parameters_to_context(codec_.get(), stream().codecpar));
    codec_->pkt_timebase = stream().time_base;
    codec_->thread_count = 1;
    codec_->max_pixels = std::int64_t{kLargestMediaSide} * kLargestMediaSide;
    codec_->err_recognition = AV_EF_EXPLODE;
    accept(avcodec_open2(codec_.get(), codec, nullptr));
}

void StreamDecoder::feed() {
    while (true) {
        const int code = av_read_frame(format_.get(), packet_.get());
        if (code == AVERROR_EOF) {
            accept(avcodec_send_packet(codec_.get(), nullptr));
            return;
        }
        accept(code);
        const bool ours = packet_->stream_index == index_;
        const int sent = ours ? avcodec_send_packet(codec_.get(), packet_.get()) : 0;
        av_packet_unref(packet_.get());
        accept(sent);
        if (ours) return;
    }
}

double seconds(std::int64_t stamp, AVRational base) {
    return static_cast<double>(stamp) * base.num / static_cast<double>(base.den);
}

}  // namespace viaface::libav
