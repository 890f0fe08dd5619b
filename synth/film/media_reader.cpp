// The decoding half of libav.
#include "synth/film/media_reader.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "base/error.hpp"

namespace viaface {
namespace {

struct Free {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
    void operator()(AVIOContext* io) const {
        av_freep(&io->buffer);
        avio_context_free(&io);
    }
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
    void operator()(SwrContext* resampler) const { swr_free(&resampler); }
};
template <class T>
using Handle = std::unique_ptr<T, Free>;

constexpr const char* kAllowed = "a video or sound file that can be decoded";

std::string name_of(const MediaSource& source) {
    if (const auto* path = std::get_if<std::filesystem::path>(&source)) return path->string();
    return std::to_string(std::get<std::span<const std::uint8_t>>(source).size()) + " bytes";
}

// Bytes in memory, read and sought as a file.
struct MemoryFile {
    std::span<const std::uint8_t> bytes;
    std::int64_t at = 0;

    static int read(void* self, std::uint8_t* to, int size) {
        auto& file = *static_cast<MemoryFile*>(self);
        const std::int64_t left = static_cast<std::int64_t>(file.bytes.size()) - file.at;
        if (left <= 0) return AVERROR_EOF;
        const int count = static_cast<int>(std::min<std::int64_t>(size, left));
        std::memcpy(to, file.bytes.data() + file.at, static_cast<std::size_t>(count));
        file.at += count;
        return count;
    }
    static std::int64_t seek(void* self, std::int64_t offset, int whence) {
        auto& file = *static_cast<MemoryFile*>(self);
        const auto size = static_cast<std::int64_t>(file.bytes.size());
        if (whence == AVSEEK_SIZE) return size;
        const std::int64_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : size;
        if (offset < -from || offset > size - from) return AVERROR(EINVAL);
        return file.at = from + offset;
    }
};

// One stream of a file, decoded frame by frame.
class StreamDecoder {
  public:
    StreamDecoder(const MediaSource& source, AVMediaType kind) : name_(name_of(source)) {
        av_log_set_level(AV_LOG_QUIET);  // what goes wrong is thrown
        open(source);
        check(avformat_find_stream_info(format_.get(), nullptr));
        const AVCodec* codec = nullptr;
        index_ = av_find_best_stream(format_.get(), kind, -1, -1, &codec, 0);
        if (index_ == AVERROR_STREAM_NOT_FOUND) return;
        check(index_);
        open_codec(codec);
    }

    bool found() const { return codec_ != nullptr; }
    const AVStream& stream() const { return *format_->streams[index_]; }
    const AVCodecContext& codec() const { return *codec_; }

    // nullptr after the last.
    const AVFrame* next() {
        while (true) {
            const int code = avcodec_receive_frame(codec_.get(), frame_.get());
            if (code == AVERROR_EOF) return nullptr;
            if (code != AVERROR(EAGAIN)) {
                check(code);
                return frame_.get();
            }
            feed();
        }
    }

    int check(int code) const {
        if (code < 0) refuse();
        return code;
    }
    [[noreturn]] void refuse(const char* allowed = kAllowed) const {
        throw InputError("media", name_, allowed);
    }

  private:
    void open(const MediaSource& source) {
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
        check(avformat_open_input(&format, url.c_str(), nullptr, nullptr));
        format_.reset(format);
    }

    void open_codec(const AVCodec* codec) {
        codec_.reset(avcodec_alloc_context3(codec));
        if (!codec_) throw std::bad_alloc();
        check(avcodec_parameters_to_context(codec_.get(), stream().codecpar));
        codec_->pkt_timebase = stream().time_base;
        codec_->thread_count = 1;
        codec_->max_pixels = std::int64_t{kLargestMediaSide} * kLargestMediaSide;
        codec_->err_recognition = AV_EF_EXPLODE;
        check(avcodec_open2(codec_.get(), codec, nullptr));
    }

    void feed() {
        while (true) {
            const int code = av_read_frame(format_.get(), packet_.get());
            if (code == AVERROR_EOF) {
                check(avcodec_send_packet(codec_.get(), nullptr));
                return;
            }
            check(code);
            const bool ours = packet_->stream_index == index_;
            const int sent = ours ? avcodec_send_packet(codec_.get(), packet_.get()) : 0;
            av_packet_unref(packet_.get());
            check(sent);
            if (ours) return;
        }
    }

    std::string name_;
    MemoryFile memory_;
    Handle<AVIOContext> io_;
    Handle<AVFormatContext> format_;
    Handle<AVCodecContext> codec_;
    Handle<AVPacket> packet_{av_packet_alloc()};
    Handle<AVFrame> frame_{av_frame_alloc()};
    int index_ = -1;
};

double seconds(std::int64_t stamp, AVRational base) {
    return static_cast<double>(stamp) * base.num / static_cast<double>(base.den);
}

// The matrix the file names; without a name BT.601 up to 576 rows and BT.709 above, as players do.
int matrix_of(const AVFrame& frame) {
    switch (frame.colorspace) {
        case AVCOL_SPC_BT709:
            return SWS_CS_ITU709;
        case AVCOL_SPC_BT2020_NCL:
        case AVCOL_SPC_BT2020_CL:
            return SWS_CS_BT2020;
        case AVCOL_SPC_FCC:
            return SWS_CS_FCC;
        case AVCOL_SPC_SMPTE240M:
            return SWS_CS_SMPTE240M;
        case AVCOL_SPC_UNSPECIFIED:
            return frame.height > 576 ? SWS_CS_ITU709 : SWS_CS_ITU601;
        default:
            return SWS_CS_ITU601;
    }
}

void set_colours(SwsContext* scaler, const AVFrame& frame) {
    const auto* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    const bool rgb = format && (format->flags & AV_PIX_FMT_FLAG_RGB);
    const bool full = rgb || frame.color_range == AVCOL_RANGE_JPEG;
    const int* matrix = sws_getCoefficients(matrix_of(frame));
    sws_setColorspaceDetails(scaler, matrix, full ? 1 : 0, matrix, 1, 0, 1 << 16,
                             1 << 16);  // refused where unused
}

bool chroma_is_left(const AVFrame& frame) {
    return frame.chroma_location == AVCHROMA_LOC_LEFT || frame.chroma_location == AVCHROMA_LOC_UNSPECIFIED;
}

Handle<SwsContext> to_rgba(const AVFrame& frame) {
    Handle<SwsContext> scaler(sws_alloc_context());
    if (!scaler) throw std::bad_alloc();
    const auto set = [&](const char* name, std::int64_t value) {
        av_opt_set_int(scaler.get(), name, value, 0);
    };
    set("srcw", frame.width);
    set("srch", frame.height);
    set("src_format", frame.format);
    set("dstw", frame.width);
    set("dsth", frame.height);
    set("dst_format", AV_PIX_FMT_RGBA);
    set("sws_flags", SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT);
    if (chroma_is_left(frame)) {
        set("src_h_chr_pos", 0);
        set("src_v_chr_pos", 128);
    }
    if (sws_init_context(scaler.get(), nullptr, nullptr) < 0) return nullptr;
    set_colours(scaler.get(), frame);
    return scaler;
}

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
        decoder_.check(swr_alloc_set_opts2(&mixer, &mono, AV_SAMPLE_FMT_FLT, rate_, &layout,
                                           static_cast<AVSampleFormat>(frame.format), rate_, 0, nullptr));
        mixer_.reset(mixer);
        decoder_.check(swr_init(mixer_.get()));
        layout_format_ = {frame.ch_layout.nb_channels, frame.format};
    }

    std::vector<float> mix(const AVFrame& frame) {
        if (layout_format_ != std::pair(frame.ch_layout.nb_channels, frame.format)) decoder_.refuse();
        std::vector<float> mono(static_cast<std::size_t>(frame.nb_samples));
        auto* out = reinterpret_cast<std::uint8_t*>(mono.data());
        const auto** in = const_cast<const std::uint8_t**>(frame.extended_data);
        decoder_.check(swr_convert(mixer_.get(), &out, frame.nb_samples, in, frame.nb_samples));
        return mono;
    }

    // Stamps may be coarse (1 ms in Matroska): sound goes on without a break while they nearly agree.
    void place(const AVFrame& frame, const std::vector<float>& mono) {
        const double here = static_cast<double>(end_) / rate_;
        const std::int64_t stamp = frame.best_effort_timestamp;
        const double asked = stamp == AV_NOPTS_VALUE ? here : seconds(stamp, decoder_.stream().time_base);
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

}  // namespace

class FrameReader::Decoding {
  public:
    explicit Decoding(const MediaSource& source) : decoder(source, AVMEDIA_TYPE_VIDEO) {
        if (!decoder.found()) decoder.refuse("a file with pictures");
    }

    std::optional<TimedFrame> next() {
        const AVFrame* decoded = decoder.next();
        if (!decoded) return std::nullopt;
        if (decoded->best_effort_timestamp == AV_NOPTS_VALUE) decoder.refuse("pictures with times");
        return TimedFrame{converted(*decoded),
                          seconds(decoded->best_effort_timestamp, decoder.stream().time_base)};
    }

    StreamDecoder decoder;

  private:
    Frame converted(const AVFrame& decoded) {
        const std::array<int, 3> shape{decoded.width, decoded.height, decoded.format};
        if (shape != shape_) scaler_ = to_rgba(decoded);
        shape_ = shape;
        if (!scaler_ || decoded.width <= 0 || decoded.height <= 0) decoder.refuse();
        Frame frame{decoded.width, decoded.height, {}};
        frame.rgba.resize(std::size_t{4} * static_cast<std::size_t>(decoded.width) *
                          static_cast<std::size_t>(decoded.height));
        std::uint8_t* rows[] = {frame.rgba.data()};
        const int strides[] = {4 * decoded.width};
        decoder.check(
            sws_scale(scaler_.get(), decoded.data, decoded.linesize, 0, decoded.height, rows, strides));
        return frame;
    }

    std::array<int, 3> shape_{};
    Handle<SwsContext> scaler_;
};

FrameReader::FrameReader(const MediaSource& source) : decoding_(std::make_unique<Decoding>(source)) {}
FrameReader::~FrameReader() = default;

int FrameReader::width() const { return decoding_->decoder.codec().width; }
int FrameReader::height() const { return decoding_->decoder.codec().height; }

double FrameReader::frames_per_s() const {
    const AVRational rate = decoding_->decoder.stream().avg_frame_rate;
    return rate.den == 0 ? 0 : av_q2d(rate);
}

std::optional<TimedFrame> FrameReader::next() { return decoding_->next(); }

std::vector<std::int16_t> read_sound(const MediaSource& source, int rate) {
    StreamDecoder decoder(source, AVMEDIA_TYPE_AUDIO);
    if (!decoder.found()) return {};
    SoundTimeline timeline(decoder);
    while (const AVFrame* frame = decoder.next()) timeline.add(*frame);
    if (timeline.rate() == 0) return {};
    return resampled(timeline.samples(), timeline.rate(), rate);
}

}  // namespace viaface
