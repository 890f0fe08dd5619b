// The encoding half of libav: encoders, containers, and the order of packets in them.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavcodec/bsf.h>
#include <libavformat/avformat.h>
#include <libavutil/audio_fifo.h>
#include <libavutil/channel_layout.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/film/film_writer.hpp"
#include "synth/film/overlapped_writer.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr int kFilmSoundRate = 48000;  // Hz, of AAC
constexpr int kPcmBlock = 1024;        // samples a packet
constexpr int kKeyFrameSeconds = 2;
constexpr int kFragmentsPerSecond = 10;

struct Free {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVBSFContext* filter) const { av_bsf_free(&filter); }
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
    void operator()(SwrContext* resampler) const { swr_free(&resampler); }
    void operator()(AVAudioFifo* fifo) const { av_audio_fifo_free(fifo); }
};
template <class T>
using Handle = std::unique_ptr<T, Free>;

int check(int code, const char* what) {
    if (code >= 0) return code;
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(code, text.data(), text.size());
    throw std::runtime_error(std::string(what) + ": " + text.data());
}

template <class T>
Handle<T> made(T* handle, const char* what) {
    if (!handle) throw std::runtime_error(std::string(what) + " failed");
    return Handle<T>(handle);
}

using Options = std::vector<std::pair<const char*, std::string>>;

// Every option must be known: one that is left over is an error, not ignored.
template <class Open>
void with_options(const Options& options, const char* what, Open open) {
    struct Dictionary {
        AVDictionary* entries = nullptr;
        ~Dictionary() { av_dict_free(&entries); }
    } dictionary;
    for (const auto& [key, value] : options) av_dict_set(&dictionary.entries, key, value.c_str(), 0);
    check(open(&dictionary.entries), what);
    if (av_dict_count(dictionary.entries) > 0) {
        throw std::runtime_error(std::string(what) + ": an option is unknown");
    }
}

AVRational stamp_base(FrameRate fps) { return {fps.denominator, fps.numerator}; }

using PacketTaker = std::function<void(Handle<AVPacket>)>;

// ---- encoders ----

Handle<AVCodecContext> new_codec(const char* name) {
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

struct PictureRecipe {
    const char* codec;
    AVPixelFormat pixels;
    Options options;
    bool bt709 = false;
};

PictureRecipe h264(bool streamed) {
    Options options{{"preset", "veryfast"}, {"crf", "20"}};
    if (streamed) options.emplace_back("tune", "zerolatency");
    return {"libx264", AV_PIX_FMT_YUV420P, std::move(options), true};
}

PictureRecipe ffv1() {
    return {"ffv1", AV_PIX_FMT_BGR0, {{"level", "3"}, {"slices", "4"}, {"slicecrc", "1"}, {"g", "1"}}};
}

PictureRecipe png() { return {"png", AV_PIX_FMT_RGBA, {{"compression_level", "4"}, {"pred", "sub"}}}; }

// Takes pictures, gives packets whose stamps count frames.
class PictureEncoder {
  public:
    PictureEncoder(const FilmSpec& spec, const PictureRecipe& recipe, bool global_header)
        : codec_(new_codec(recipe.codec)), picture_(made(av_frame_alloc(), "av_frame_alloc")) {
        codec_->width = spec.width;
        codec_->height = spec.height;
        codec_->pix_fmt = recipe.pixels;
        codec_->time_base = stamp_base(spec.fps);
        codec_->framerate = {spec.fps.numerator, spec.fps.denominator};
        codec_->sample_aspect_ratio = {1, 1};
        codec_->gop_size = kKeyFrameSeconds * spec.fps.numerator / spec.fps.denominator;
        if (recipe.bt709) tag_bt709();
        if (global_header) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        with_options(recipe.options, "opening the picture encoder",
                     [&](AVDictionary** options) { return avcodec_open2(codec_.get(), nullptr, options); });
        open_scaler(recipe.bt709);
    }

    const AVCodecContext& codec() const { return *codec_; }
    std::int64_t frames() const { return frames_; }

    void add(const FrameView& view, const PacketTaker& take) {
        if (view.width != codec_->width || view.height != codec_->height) {
            throw std::invalid_argument("a frame must have the size of the film");
        }
        convert(view);
        picture_->pts = frames_++;
        encode(*codec_, picture_.get(), take);
    }
    void end(const PacketTaker& take) { encode(*codec_, nullptr, take); }

  private:
    void tag_bt709() {
        codec_->colorspace = AVCOL_SPC_BT709;
        codec_->color_primaries = AVCOL_PRI_BT709;
        codec_->color_trc = AVCOL_TRC_BT709;
        codec_->color_range = AVCOL_RANGE_MPEG;
        codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
    }

    void open_scaler(bool bt709) {
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
            check(sws_setColorspaceDetails(scaler_.get(), matrix, 1, matrix, 0, 0, 1 << 16, 1 << 16),
                  "colours");
        }
    }

    void convert(const FrameView& view) {
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

    Handle<AVCodecContext> codec_;
    Handle<SwsContext> scaler_;
    Handle<AVFrame> picture_;
    std::int64_t frames_ = 0;
};

// Takes 16 bit mono, gives packets whose stamps count samples of the film's sound.
class SoundEncoder {
  public:
    SoundEncoder(const char* name, int rate_in, int rate_out, bool global_header) : codec_(new_codec(name)) {
        codec_->sample_fmt = codec_->codec->sample_fmts[0];
        codec_->sample_rate = rate_out;
        codec_->time_base = {1, rate_out};
        codec_->bit_rate = 96000;
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

    const AVCodecContext& codec() const { return *codec_; }
    std::int64_t samples_in() const { return samples_in_; }

    void add(std::span<const std::int16_t> samples, const PacketTaker& take) {
        constexpr std::size_t kPiece = 1 << 16;  // samples resampled at a time
        for (; !samples.empty(); samples = samples.subspan(std::min(kPiece, samples.size()))) {
            resample(samples.first(std::min(kPiece, samples.size())));
            while (av_audio_fifo_size(fifo_.get()) >= block()) send(block(), take);
        }
    }

    // Ends after exactly `total` samples of the film's sound, with silence where there is none.
    void end(std::int64_t total, const PacketTaker& take) {
        resample({});
        while (sent_ < total) send(static_cast<int>(std::min<std::int64_t>(block(), total - sent_)), take);
        encode(*codec_, nullptr, take);
    }

  private:
    int block() const { return codec_->frame_size > 0 ? codec_->frame_size : kPcmBlock; }

    void resample(std::span<const std::int16_t> samples) {
        samples_in_ += static_cast<std::int64_t>(samples.size());
        const int count = static_cast<int>(samples.size());
        const auto out =
            new_block(check(swr_get_out_samples(resampler_.get(), count), "swr_get_out_samples") + 1);
        const auto* in = reinterpret_cast<const std::uint8_t*>(samples.data());
        const int got =
            check(swr_convert(resampler_.get(), out->data, out->nb_samples, count > 0 ? &in : nullptr, count),
                  "swr_convert");
        check(av_audio_fifo_write(fifo_.get(), reinterpret_cast<void**>(out->data), got),
              "av_audio_fifo_write");
    }

    Handle<AVFrame> new_block(int samples) const {
        auto frame = made(av_frame_alloc(), "av_frame_alloc");
        frame->nb_samples = samples;
        frame->format = codec_->sample_fmt;
        frame->sample_rate = codec_->sample_rate;
        check(av_channel_layout_copy(&frame->ch_layout, &codec_->ch_layout), "av_channel_layout_copy");
        check(av_frame_get_buffer(frame.get(), 0), "av_frame_get_buffer");
        return frame;
    }

    void send(int samples, const PacketTaker& take) {
        const auto frame = new_block(samples);
        const int got = check(av_audio_fifo_read(fifo_.get(), reinterpret_cast<void**>(frame->data), samples),
                              "av_audio_fifo_read");
        check(av_samples_set_silence(frame->data, got, samples - got, 1, codec_->sample_fmt), "silence");
        frame->pts = sent_;
        sent_ += samples;
        encode(*codec_, frame.get(), take);
    }

    Handle<AVCodecContext> codec_;
    Handle<SwrContext> resampler_;
    Handle<AVAudioFifo> fifo_;
    std::int64_t samples_in_ = 0, sent_ = 0;
};

// x264 writes its version and settings into SEI units before the first frame.
class SeiRemover {
  public:
    explicit SeiRemover(const AVCodecContext& codec) {
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

    Handle<AVPacket> clean(Handle<AVPacket> packet) {
        check(av_bsf_send_packet(filter_.get(), packet.get()), "av_bsf_send_packet");
        check(av_bsf_receive_packet(filter_.get(), packet.get()), "av_bsf_receive_packet");
        return packet;
    }

  private:
    Handle<AVBSFContext> filter_;
};

// ---- containers ----

std::string url(const fs::path& path) { return "file:" + path.string(); }

// A container that writes to a file or a sink, the latter from the first packet on. Packets come in the order
// of their decoding.
class Container {
  public:
    Container(const char* format, Options options, const fs::path& path)
        : Container(format, std::move(options), url(path).c_str()) {
        check(avio_open(&context_->pb, context_->url, AVIO_FLAG_WRITE), "opening the film");
    }
    Container(const char* format, Options options, FilmSink sink)
        : Container(format, std::move(options), "") {
        sink_ = std::move(sink);
        constexpr int kBuffer = 1 << 16;
        auto* buffer = static_cast<std::uint8_t*>(av_malloc(kBuffer));
        context_->pb =
            avio_alloc_context(buffer, kBuffer, 1, this, nullptr, &Container::write_to_sink, nullptr);
        if (!context_->pb) throw std::runtime_error("avio_alloc_context failed");
        context_->flags |= AVFMT_FLAG_CUSTOM_IO;
    }
    ~Container() {
        close();
        avformat_free_context(context_);
    }
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;

    void add_stream(const AVCodecContext& codec) {
        AVStream* stream = avformat_new_stream(context_, nullptr);
        if (!stream) throw std::runtime_error("avformat_new_stream failed");
        check(avcodec_parameters_from_context(stream->codecpar, &codec), "avcodec_parameters_from_context");
        stream->time_base = codec.time_base;
        stream->avg_frame_rate = codec.framerate;
        stream->sample_aspect_ratio = codec.sample_aspect_ratio;
        bases_.push_back(codec.time_base);
    }

    void write(AVPacket& packet, int stream) {
        if (!begun_) begin();
        packet.stream_index = stream;
        av_packet_rescale_ts(&packet, bases_[stream], context_->streams[stream]->time_base);
        check_writing(av_write_frame(context_, &packet));
    }

    // Ends the fragment: what was written has left when this returns.
    void cut() {
        check_writing(av_write_frame(context_, nullptr));
        avio_flush(context_->pb);
        check_sink();
    }

    void end() {
        check_writing(av_write_trailer(context_));
        avio_flush(context_->pb);
        check_sink();
        check(close(), "closing the film");
    }

  private:
    Container(const char* format, Options options, const char* url) : options_(std::move(options)) {
        check(avformat_alloc_output_context2(&context_, nullptr, format, url),
              "avformat_alloc_output_context2");
        context_->flags |= AVFMT_FLAG_BITEXACT;
    }

    void begin() {
        begun_ = true;
        with_options(options_, "beginning the film", [this](AVDictionary** options) {
            const int code = avformat_write_header(context_, options);
            check_sink();
            return code;
        });
    }

    static int write_to_sink(void* self, std::uint8_t* bytes, int size) {
        auto& container = *static_cast<Container*>(self);
        if (container.left_ || container.sink_error_) return AVERROR_EXIT;
        try {
            container.left_ = !container.sink_({bytes, static_cast<std::size_t>(size)});
        } catch (...) {
            container.sink_error_ = std::current_exception();
        }
        return container.left_ || container.sink_error_ ? AVERROR_EXIT : size;
    }

    void check_sink() const {
        if (sink_error_) std::rethrow_exception(sink_error_);
        if (left_) throw ClientLeft();
        check(context_->pb->error, "writing the film");
    }
    void check_writing(int code) const {
        check_sink();
        check(code, "writing the film");
    }

    int close() {
        if (!context_->pb) return 0;
        if (!(context_->flags & AVFMT_FLAG_CUSTOM_IO)) return avio_closep(&context_->pb);
        left_ = true;  // nothing that is still buffered reaches the sink
        av_freep(&context_->pb->buffer);
        avio_context_free(&context_->pb);
        return 0;
    }

    AVFormatContext* context_ = nullptr;
    Options options_;
    FilmSink sink_;
    std::vector<AVRational> bases_;
    bool begun_ = false, left_ = false;
    std::exception_ptr sink_error_;
};

// Puts picture and sound packets in the order of their decoding times, and cuts fragments.
class Interleaver {
  public:
    static constexpr int kPicture = 0, kSound = 1;

    Interleaver(Container& container, AVRational picture_base, AVRational sound_base, int frames_per_fragment)
        : container_(container),
          bases_{picture_base, sound_base},
          frames_per_fragment_(frames_per_fragment) {}

    void add(int stream, Handle<AVPacket> packet) {
        queues_[stream].push_back(std::move(packet));
        drain();
    }
    void end(int stream) {
        ended_[stream] = true;
        drain();
    }

  private:
    void drain() {
        while (true) {
            if (fragment_is_whole()) cut();
            const int stream = next();
            if (stream < 0) return;
            write(stream);
        }
    }

    void write(int stream) {
        const auto packet = std::move(queues_[stream].front());
        queues_[stream].pop_front();
        const std::int64_t pts = packet->pts;
        if (stream == kSound) sound_end_ = pts + packet->duration;
        container_.write(*packet, stream);
        if (stream == kPicture && frames_per_fragment_ > 0 && pts % frames_per_fragment_ == 0)
            cut_at_ = pts + 1;
    }

    void cut() {
        container_.cut();
        cut_at_.reset();
    }

    // Its last frame is in, and all sound up to the end of that frame.
    bool fragment_is_whole() const {
        if (!cut_at_) return false;
        const bool sounded = av_compare_ts(sound_end_, bases_[kSound], *cut_at_, bases_[kPicture]) >= 0;
        return sounded || (ended_[kSound] && queues_[kSound].empty());
    }

    // The stream whose packet comes next; -1 until that is known.
    int next() const {
        const auto& [pictures, sounds] = queues_;
        if (cut_at_) return sounds.empty() ? -1 : kSound;
        if (pictures.empty() && sounds.empty()) return -1;
        if (pictures.empty()) return ended_[kPicture] ? kSound : -1;
        if (sounds.empty()) return ended_[kSound] ? kPicture : -1;
        const int order =
            av_compare_ts(sounds.front()->dts, bases_[kSound], pictures.front()->dts, bases_[kPicture]);
        return order <= 0 ? kSound : kPicture;
    }

    Container& container_;
    std::array<AVRational, 2> bases_;
    int frames_per_fragment_;  // 0: no fragments
    std::array<std::deque<Handle<AVPacket>>, 2> queues_;
    std::array<bool, 2> ended_{};
    std::int64_t sound_end_ = 0;          // in samples, of what is written
    std::optional<std::int64_t> cut_at_;  // in frames
};

// ---- films ----

void check_lengths(const FilmSpec& spec, std::int64_t frames, std::int64_t samples) {
    if (frames == 0) throw std::invalid_argument("a film needs a frame");
    const std::int64_t needed = frames_for(samples, spec.sample_rate, spec.fps);
    if (needed > frames) {
        throw std::invalid_argument("the sound needs " + std::to_string(needed) + " frames, the film has " +
                                    std::to_string(frames));
    }
}

struct ContainerRecipe {
    PictureRecipe picture;
    const char* sound;
    int sound_rate;
    Options options;
    int frames_per_fragment = 0;
    bool remove_sei = false;
};

ContainerRecipe mp4_file() {
    return {h264(false), "aac", kFilmSoundRate, {{"movflags", "faststart"}}, 0, true};
}

ContainerRecipe mp4_stream(FrameRate fps) {
    const int frames = std::max(1, fps.numerator / (fps.denominator * kFragmentsPerSecond));
    return {h264(true), "aac", kFilmSoundRate, {{"movflags", "frag_custom+empty_moov+default_base_moof"}},
            frames,     true};
}

ContainerRecipe mkv_file(int sample_rate) { return {ffv1(), "pcm_s16le", sample_rate, {}}; }

class ContainerFilm : public FilmWriter {
  public:
    ContainerFilm(const FilmSpec& spec, const ContainerRecipe& recipe, const char* format,
                  const fs::path& output)
        : ContainerFilm(spec, recipe) {
        file_.emplace(output);
        container_.emplace(format, recipe.options, file_->path());
        add_streams(recipe.frames_per_fragment);
    }
    ContainerFilm(const FilmSpec& spec, const ContainerRecipe& recipe, const char* format, FilmSink sink)
        : ContainerFilm(spec, recipe) {
        container_.emplace(format, recipe.options, std::move(sink));
        add_streams(recipe.frames_per_fragment);
    }

    void add_frame(const FrameView& frame) override {
        picture_.add(frame, take_picture());
        encode_due_sound();
    }
    void add_sound(std::span<const std::int16_t> samples) override {
        waiting_.insert(waiting_.end(), samples.begin(), samples.end());
        encode_due_sound();
    }

    void finish() override {
        const auto waiting = static_cast<std::int64_t>(waiting_.size());
        check_lengths(spec_, picture_.frames(), sound_.samples_in() + waiting);
        encode_sound(waiting);
        picture_.end(take_picture());
        interleaver_->end(Interleaver::kPicture);
        sound_.end(samples_for(picture_.frames(), sound_.codec().sample_rate, spec_.fps), take_sound());
        interleaver_->end(Interleaver::kSound);
        container_->end();
        if (file_) file_->commit();
    }

  private:
    ContainerFilm(const FilmSpec& spec, const ContainerRecipe& recipe)
        : spec_(spec),
          drop_priming_(recipe.frames_per_fragment > 0),
          picture_(spec, recipe.picture, true),
          sound_(recipe.sound, spec.sample_rate, recipe.sound_rate, true) {
        if (recipe.remove_sei) cleaner_.emplace(picture_.codec());
    }

    void add_streams(int frames_per_fragment) {
        container_->add_stream(picture_.codec());
        container_->add_stream(sound_.codec());
        interleaver_.emplace(*container_, picture_.codec().time_base, sound_.codec().time_base,
                             frames_per_fragment);
    }

    // A sentence that arrives whole must not hold up its first frame: sound is encoded as the picture needs
    // it.
    void encode_due_sound() {
        const std::int64_t ahead = spec_.sample_rate / kFragmentsPerSecond;
        const std::int64_t due = samples_for(picture_.frames(), spec_.sample_rate, spec_.fps) + ahead;
        encode_sound(std::min(due - sound_.samples_in(), static_cast<std::int64_t>(waiting_.size())));
    }

    void encode_sound(std::int64_t count) {
        if (count <= 0) return;
        const std::vector<std::int16_t> samples(waiting_.begin(), waiting_.begin() + count);
        waiting_.erase(waiting_.begin(), waiting_.begin() + count);
        sound_.add(samples, take_sound());
    }

    PacketTaker take_picture() {
        return [this](Handle<AVPacket> packet) {
            packet->duration = 1;
            interleaver_->add(Interleaver::kPicture,
                              cleaner_ ? cleaner_->clean(std::move(packet)) : std::move(packet));
        };
    }
    PacketTaker take_sound() {
        return [this](Handle<AVPacket> packet) {
            if (drop_priming_ && packet->pts < 0) return;
            interleaver_->add(Interleaver::kSound, std::move(packet));
        };
    }

    FilmSpec spec_;
    bool drop_priming_;
    std::optional<WholeFile> file_;
    PictureEncoder picture_;
    SoundEncoder sound_;
    std::deque<std::int16_t> waiting_;  // sound that no frame needs yet
    std::optional<SeiRemover> cleaner_;
    std::optional<Container> container_;
    std::optional<Interleaver> interleaver_;
};

// frame_00000.png, frame_00001.png, ... and sound.wav in a folder that appears whole.
class PngFolder : public FilmWriter {
  public:
    PngFolder(const FilmSpec& spec, const fs::path& output)
        : spec_(spec),
          folder_(output),
          picture_(spec, png(), false),
          sound_("pcm_s16le", spec.sample_rate, spec.sample_rate, false) {
        sound_file_.emplace("wav", Options{}, folder_.path() / "sound.wav");
        sound_file_->add_stream(sound_.codec());
    }

    void add_frame(const FrameView& frame) override { picture_.add(frame, take_picture()); }
    void add_sound(std::span<const std::int16_t> samples) override { sound_.add(samples, take_sound()); }

    void finish() override {
        check_lengths(spec_, picture_.frames(), sound_.samples_in());
        picture_.end(take_picture());
        sound_.end(samples_for(picture_.frames(), spec_.sample_rate, spec_.fps), take_sound());
        sound_file_->end();
        folder_.commit();
    }

  private:
    PacketTaker take_picture() {
        return [this](Handle<AVPacket> packet) {
            std::array<char, 32> name{};
            std::snprintf(name.data(), name.size(), "frame_%05lld.png", static_cast<long long>(packet->pts));
            write_whole(folder_.path() / name.data(),
                        std::span(packet->data, static_cast<std::size_t>(packet->size)));
        };
    }
    PacketTaker take_sound() {
        return [this](Handle<AVPacket> packet) { sound_file_->write(*packet, 0); };
    }

    FilmSpec spec_;
    WholeFolder folder_;
    PictureEncoder picture_;
    SoundEncoder sound_;
    std::optional<Container> sound_file_;
};

std::unique_ptr<FilmWriter> open_inner(const FilmSpec& spec, const fs::path& output) {
    switch (spec.format) {
        case FilmFormat::kMp4:
            return std::make_unique<ContainerFilm>(spec, mp4_file(), "mp4", output);
        case FilmFormat::kMkv:
            return std::make_unique<ContainerFilm>(spec, mkv_file(spec.sample_rate), "matroska", output);
        case FilmFormat::kPng:
            return std::make_unique<PngFolder>(spec, output);
    }
    throw std::logic_error("unknown film format");
}

}  // namespace

std::unique_ptr<FilmWriter> open_film(const FilmSpec& spec, const std::filesystem::path& output) {
    validate(spec);
    av_log_set_level(AV_LOG_QUIET);  // what goes wrong is thrown
    return std::make_unique<OverlappedWriter>(open_inner(spec, output));
}

std::unique_ptr<FilmWriter> open_film(const FilmSpec& spec, FilmSink sink) {
    validate(spec);
    if (spec.format != FilmFormat::kMp4) throw InputError("format", "mkv or png as a stream", "mp4");
    av_log_set_level(AV_LOG_QUIET);
    return std::make_unique<OverlappedWriter>(
        std::make_unique<ContainerFilm>(spec, mp4_stream(spec.fps), "mp4", std::move(sink)));
}

}  // namespace viaface
