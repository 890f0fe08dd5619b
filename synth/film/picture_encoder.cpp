#include "synth/film/picture_encoder.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace viaface::libav {
namespace {

constexpr int kKeyFrameSeconds = 2;

}  // namespace

PictureRecipe h264(bool streamed) {
    Options options{{"preset", "veryfast"}, {"crf", "20"}};
    if (streamed) options.emplace_back("tune", "zerolatency");
    return {"libx264", AV_PIX_FMT_YUV420P, std::move(options), true};
}

PictureRecipe ffv1() {
    return {"ffv1", AV_PIX_FMT_BGR0, {{"level", "3"}, {"slices", "4"}, {"slicecrc", "1"}, {"g", "1"}}};
}

PictureRecipe png() { return {"png", AV_PIX_FMT_RGBA, {{"compression_level", "4"}, {"pred", "sub"}}}; }

PictureEncoder::PictureEncoder(const FilmSpec& spec, const PictureRecipe& recipe, bool global_header)
    : codec_(new_encoder(recipe.codec)), picture_(made(av_frame_alloc(), "av_frame_alloc")) {
    codec_->width = spec.width;
    codec_->height = spec.height;
    codec_->pix_fmt = recipe.pixels;
    codec_->time_base = {spec.fps.denominator, spec.fps.numerator};
    codec_->framerate = {spec.fps.numerator, spec.fps.denominator};
    codec_->sample_aspect_ratio = {1, 1};
    codec_->gop_size = kKeyFrameSeconds * spec.fps.numerator / spec.fps.denominator;
    if (recipe.bt709) tag_bt709();
    if (global_header) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    with_options(recipe.options, "opening the picture encoder",
                 [&](AVDictionary** options) { return avcodec_open2(codec_.get(), nullptr, options); });
    open_scaler(recipe.bt709);
}

void PictureEncoder::add(const FrameView& view, const PacketTaker& take) {
    if (view.width != codec_->width || view.height != codec_->height) {
        throw std::invalid_argument("a frame must have the size of the film");
    }
    convert(view);
    picture_->pts = frames_++;
    encode(*codec_, picture_.get(), take);
}

void PictureEncoder::tag_bt709() {
    codec_->colorspace = AVCOL_SPC_BT709;
    codec_->color_primaries = AVCOL_PRI_BT709;
    codec_->color_trc = AVCOL_TRC_BT709;
    codec_->color_range = AVCOL_RANGE_MPEG;
    codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
}

void PictureEncoder::open_scaler(bool bt709) {
    scaler_ = made(sws_alloc_context(), "sws_alloc_context");
    const auto set = [this](const char* name, std::int64_t value) {
        check(av_opt_set_int(scaler_.get(), name, value, 0), name);
    };
    set("srcw", codec_->width);
    set("srch", codec_->height);
    set("dstw", codec_->width);
    set("dsth", codec_->height);
    set("src_format", AV_PIX_FMT_RGBA);
    set("dst_format", codec_->pix_fmt);
    set("sws_flags", SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_BITEXACT);
    if (bt709) {
        set("dst_h_chr_pos", 0);  // chroma sits on the left luma column, half way between rows
        set("dst_v_chr_pos", 128);
    }
    check(sws_init_context(scaler_.get(), nullptr, nullptr), "sws_init_context");
    if (bt709) {
        const int* matrix = sws_getCoefficients(SWS_CS_ITU709);
        check(sws_setColorspaceDetails(scaler_.get(), matrix, 1, matrix, 0, 0, 1 << 16, 1 << 16), "colours");
    }
}

void PictureEncoder::convert(const FrameView& view) {
    av_frame_unref(picture_.get());
    picture_->width = view.width;
    picture_->height = view.height;
    picture_->format = codec_->pix_fmt;
    check(av_frame_get_buffer(picture_.get(), 0), "av_frame_get_buffer");
    const std::uint8_t* rows[] = {view.top_row};
    const int strides[] = {static_cast<int>(view.stride)};
    check(sws_scale(scaler_.get(), rows, strides, 0, view.height, picture_->data, picture_->linesize),
          "sws_scale");
}

SeiRemover::SeiRemover(const AVCodecContext& codec) {
    const AVBitStreamFilter* kind = av_bsf_get_by_name("filter_units");
    if (!kind) throw std::runtime_error("libavcodec has no filter_units");
    AVBSFContext* filter = nullptr;
    check(av_bsf_alloc(kind, &filter), "av_bsf_alloc");
    filter_ = made(filter, "av_bsf_alloc");
    check(avcodec_parameters_from_context(filter_->par_in, &codec), "avcodec_parameters_from_context");
    filter_->time_base_in = codec.time_base;
    check(av_opt_set(filter_->priv_data, "remove_types", "6", 0), "remove_types");
    check(av_bsf_init(filter_.get()), "av_bsf_init");
}

Handle<AVPacket> SeiRemover::clean(Handle<AVPacket> packet) {
    check(av_bsf_send_packet(filter_.get(), packet.get()), "av_bsf_send_packet");
    check(av_bsf_receive_packet(filter_.get(), packet.get()), "av_bsf_receive_packet");
    return packet;
}

}  // namespace viaface::libav
