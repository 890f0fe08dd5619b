#include "synth/film/film_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/film/container.hpp"
#include "synth/film/overlapped_writer.hpp"
#include "synth/film/picture_encoder.hpp"
#include "synth/film/sound_encoder.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using libav::Container, libav::Handle, libav::Interleaver, libav::Options, libav::PacketTaker,
    libav::PictureEncoder, libav::SoundEncoder;

constexpr int kFilmSoundRate = 48000;  // Hz, of AAC
constexpr int kFragmentsPerSecond = 10;

void check_lengths(const FilmSpec& spec, std::int64_t frames, std::int64_t samples) {
    if (frames == 0) throw std::invalid_argument("a film needs a frame");
    const std::int64_t needed = frames_for(samples, spec.sample_rate, spec.fps);
    if (needed > frames) {
        throw std::invalid_argument("the sound needs " + std::to_string(needed) + " frames, the film has " +
                                    std::to_string(frames));
    }
}

struct ContainerRecipe {
    libav::PictureRecipe picture;
    const char* sound;
    int sound_rate;
    Options options;
    int frames_per_fragment = 0;
    bool remove_sei = false;
};

ContainerRecipe mp4_file() {
    return {libav::h264(false), "aac", kFilmSoundRate, {{"movflags", "faststart"}}, 0, true};
}

ContainerRecipe mp4_stream(FrameRate fps) {
    const int frames = std::max(1, fps.numerator / (fps.denominator * kFragmentsPerSecond));
    return {libav::h264(true),
            "aac",
            kFilmSoundRate,
            {{"movflags", "frag_custom+empty_moov+default_base_moof"}},
            frames,
            true};
}

ContainerRecipe mkv(int sample_rate) { return {libav::ffv1(), "pcm_s16le", sample_rate, {}}; }

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
    std::optional<libav::SeiRemover> cleaner_;
    std::optional<Container> container_;
    std::optional<Interleaver> interleaver_;
};

// frame_00000.png, frame_00001.png, ... and sound.wav in a folder that appears whole.
class PngFolder : public FilmWriter {
  public:
    PngFolder(const FilmSpec& spec, const fs::path& output)
        : spec_(spec),
          folder_(output),
          picture_(spec, libav::png(), false),
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

std::unique_ptr<FilmWriter> open_file(const FilmSpec& spec, const fs::path& output) {
    switch (spec.format) {
        case FilmFormat::kMp4:
            return std::make_unique<ContainerFilm>(spec, mp4_file(), "mp4", output);
        case FilmFormat::kMkv:
            return std::make_unique<ContainerFilm>(spec, mkv(spec.sample_rate), "matroska", output);
        case FilmFormat::kPng:
            return std::make_unique<PngFolder>(spec, output);
    }
    throw std::logic_error("unknown film format");
}

std::unique_ptr<FilmWriter> open_stream(const FilmSpec& spec, FilmSink sink) {
    switch (spec.format) {
        case FilmFormat::kMp4:
            return std::make_unique<ContainerFilm>(spec, mp4_stream(spec.fps), "mp4", std::move(sink));
        case FilmFormat::kMkv:
            return std::make_unique<ContainerFilm>(spec, mkv(spec.sample_rate), "matroska", std::move(sink));
        case FilmFormat::kPng:
            throw InputError("format", "png", "mp4 or mkv for a stream");
    }
    throw std::logic_error("unknown film format");
}

}  // namespace

std::unique_ptr<FilmWriter> open_film(const FilmSpec& spec, const std::filesystem::path& output) {
    validate(spec);
    return std::make_unique<OverlappedWriter>(open_file(spec, output));
}

std::unique_ptr<FilmWriter> open_film(const FilmSpec& spec, FilmSink sink) {
    validate(spec);
    return std::make_unique<OverlappedWriter>(open_stream(spec, std::move(sink)));
}

}  // namespace viaface
