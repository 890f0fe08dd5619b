#include "synth/film/media_reader.hpp"

extern "C" {
#include <libavutil/display.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include <array>
#include <cmath>
#include <cstring>

#include "synth/film/stream_decoder.hpp"

namespace viaface {
namespace {

using libav::Handle, libav::StreamDecoder;

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

// Quarter turns clockwise that bring the pictures upright, 0 to 3.
int quarter_turns(const StreamDecoder& decoder) {
    std::size_t size = 0;
    const std::uint8_t* tag = av_stream_get_side_data(&decoder.stream(), AV_PKT_DATA_DISPLAYMATRIX, &size);
    if (!tag || size < 9 * sizeof(std::int32_t)) return 0;
    std::array<std::int32_t, 9> matrix{};
    std::memcpy(matrix.data(), tag, sizeof matrix);
    const double quarters = -av_display_rotation_get(matrix.data()) / 90;  // NaN for a matrix that is none
    if (!(std::abs(quarters - std::round(quarters)) < 0.02)) decoder.refuse("a rotation by quarter turns");
    return (static_cast<int>(std::lround(quarters)) + 4) % 4;
}

Frame turned_clockwise(const Frame& frame) {
    Frame turned{frame.height, frame.width, std::vector<std::uint8_t>(frame.rgba.size())};
    for (int y = 0; y < turned.height; ++y) {
        for (int x = 0; x < turned.width; ++x) {
            const auto from = static_cast<std::size_t>(frame.height - 1 - x) * frame.width + y;
            const auto to = static_cast<std::size_t>(y) * turned.width + x;
            std::memcpy(&turned.rgba[4 * to], &frame.rgba[4 * from], 4);
        }
    }
    return turned;
}

}  // namespace

class FrameReader::Decoding {
  public:
    explicit Decoding(const MediaSource& source) : decoder(source, AVMEDIA_TYPE_VIDEO) {
        if (!decoder.found()) decoder.refuse("a file with pictures");
        turns = quarter_turns(decoder);
    }

    std::optional<TimedFrame> next() {
        const AVFrame* decoded = decoder.next();
        if (!decoded) return std::nullopt;
        if (decoded->best_effort_timestamp == AV_NOPTS_VALUE) decoder.refuse("pictures with times");
        Frame frame = converted(*decoded);
        for (int i = 0; i < turns; ++i) frame = turned_clockwise(frame);
        return TimedFrame{std::move(frame),
                          libav::seconds(decoded->best_effort_timestamp, decoder.stream().time_base)};
    }

    StreamDecoder decoder;
    int turns = 0;  // clockwise, by quarters

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
        decoder.accept(
            sws_scale(scaler_.get(), decoded.data, decoded.linesize, 0, decoded.height, rows, strides));
        return frame;
    }

    std::array<int, 3> shape_{};
    Handle<SwsContext> scaler_;
};

FrameReader::FrameReader(const MediaSource& source) : decoding_(std::make_unique<Decoding>(source)) {}
FrameReader::~FrameReader() = default;

int FrameReader::width() const {
    const auto& codec = decoding_->decoder.codec();
    return decoding_->turns % 2 == 1 ? codec.height : codec.width;
}
int FrameReader::height() const {
    const auto& codec = decoding_->decoder.codec();
    return decoding_->turns % 2 == 1 ? codec.width : codec.height;
}

double FrameReader::frames_per_s() const {
    const AVRational rate = decoding_->decoder.stream().avg_frame_rate;
    return rate.den == 0 ? 0 : av_q2d(rate);
}

std::optional<TimedFrame> FrameReader::next() { return decoding_->next(); }

}  // namespace viaface
