#include "synth/film/container.hpp"

namespace viaface::libav {
namespace {

std::string url(const std::filesystem::path& path) { return "file:" + path.string(); }

}  // namespace

Container::Container(const char* format, Options options, const std::filesystem::path& path)
    : Container(format, std::move(options), url(path).c_str()) {
    check(avio_open(&context_->pb, context_->url, AVIO_FLAG_WRITE), "opening the film");
}

Container::Container(const char* format, Options options, FilmSink sink)
    : Container(format, std::move(options), "") {
    sink_ = std::move(sink);
    constexpr int kBuffer = 1 << 16;
    auto* buffer = static_cast<std::uint8_t*>(av_malloc(kBuffer));
    context_->pb = avio_alloc_context(buffer, kBuffer, 1, this, nullptr, &Container::write_to_sink, nullptr);
    if (!context_->pb) throw std::runtime_error("avio_alloc_context failed");
    context_->flags |= AVFMT_FLAG_CUSTOM_IO;
}

Container::Container(const char* format, Options options, const char* url) : options_(std::move(options)) {
    AVFormatContext* context = nullptr;
    check(avformat_alloc_output_context2(&context, nullptr, format, url), "avformat_alloc_output_context2");
    context_.reset(context);
    context_->flags |= AVFMT_FLAG_BITEXACT;
}

void Container::add_stream(const AVCodecContext& codec) {
    AVStream* stream = avformat_new_stream(context_.get(), nullptr);
    if (!stream) throw std::runtime_error("avformat_new_stream failed");
    check(avcodec_parameters_from_context(stream->codecpar, &codec), "avcodec_parameters_from_context");
    stream->time_base = codec.time_base;
    stream->avg_frame_rate = codec.framerate;
    stream->sample_aspect_ratio = codec.sample_aspect_ratio;
    bases_.push_back(codec.time_base);
}

void Container::write(AVPacket& packet, int stream) {
    if (!begun_) begin();
    packet.stream_index = stream;
    av_packet_rescale_ts(&packet, bases_[stream], context_->streams[stream]->time_base);
    check_writing(av_write_frame(context_.get(), &packet));
}

void Container::cut() {
    check_writing(av_write_frame(context_.get(), nullptr));
    avio_flush(context_->pb);
    check_sink();
}

void Container::end() {
    check_writing(av_write_trailer(context_.get()));
    avio_flush(context_->pb);
    check_sink();
    check(close(), "closing the film");
}

void Container::begin() {
    begun_ = true;
    with_options(options_, "beginning the film", [this](AVDictionary** options) {
        const int code = avformat_write_header(context_.get(), options);
        check_sink();
        return code;
    });
}

int Container::write_to_sink(void* self, std::uint8_t* bytes, int size) {
    auto& container = *static_cast<Container*>(self);
    if (container.left_ || container.sink_error_) return AVERROR_EXIT;
    try {
        container.left_ = !container.sink_({bytes, static_cast<std::size_t>(size)});
    } catch (...) {
        container.sink_error_ = std::current_exception();
    }
    return container.left_ || container.sink_error_ ? AVERROR_EXIT : size;
}

void Container::check_sink() const {
    if (sink_error_) std::rethrow_exception(sink_error_);
    if (left_) throw ClientLeft();
    check(context_->pb->error, "writing the film");
}

void Container::check_writing(int code) const {
    check_sink();
    check(code, "writing the film");
}

int Container::close() {
    if (!context_->pb) return 0;
    if (!(context_->flags & AVFMT_FLAG_CUSTOM_IO)) return avio_closep(&context_->pb);
    left_ = true;  // nothing that is still buffered reaches the sink
    Free()(std::exchange(context_->pb, nullptr));
    return 0;
}

Interleaver::Interleaver(Container& container, AVRational picture_base, AVRational sound_base,
                         int frames_per_fragment)
    : container_(container), bases_{picture_base, sound_base}, frames_per_fragment_(frames_per_fragment) {}

void Interleaver::add(int stream, Handle<AVPacket> packet) {
    queues_[stream].push_back(std::move(packet));
    drain();
}

void Interleaver::end(int stream) {
    ended_[stream] = true;
    drain();
}

void Interleaver::drain() {
    while (true) {
        if (fragment_is_whole()) cut();
        const int stream = next();
        if (stream < 0) return;
        write(stream);
    }
}

void Interleaver::write(int stream) {
    const auto packet = std::move(queues_[stream].front());
    queues_[stream].pop_front();
    const std::int64_t pts = packet->pts;
    if (stream == kSound) sound_end_ = pts + packet->duration;
    container_.write(*packet, stream);
    if (stream == kPicture && frames_per_fragment_ > 0 && pts % frames_per_fragment_ == 0) cut_at_ = pts + 1;
}

void Interleaver::cut() {
    container_.cut();
    cut_at_.reset();
}

// Its last frame is in, and all sound up to the end of that frame.
bool Interleaver::fragment_is_whole() const {
    if (!cut_at_) return false;
    const bool sounded = av_compare_ts(sound_end_, bases_[kSound], *cut_at_, bases_[kPicture]) >= 0;
    return sounded || (ended_[kSound] && queues_[kSound].empty());
}

// The stream whose packet comes next; -1 until that is known.
int Interleaver::next() const {
    const auto& [pictures, sounds] = queues_;
    if (cut_at_) return sounds.empty() ? -1 : kSound;
    if (pictures.empty() && sounds.empty()) return -1;
    if (pictures.empty()) return ended_[kPicture] ? kSound : -1;
    if (sounds.empty()) return ended_[kSound] ? kPicture : -1;
    const int order =
        av_compare_ts(sounds.front()->dts, bases_[kSound], pictures.front()->dts, bases_[kPicture]);
    return order <= 0 ? kSound : kPicture;
}

}  // namespace viaface::libav
