#include "synth/film/film_writer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/film/media_reader.hpp"
#include "tests/synth/film/synthetic_film.hpp"

namespace viaface {
namespace {

using namespace test;
namespace fs = std::filesystem;

struct Way {
    const char* name;
    FilmFormat format;
    bool streamed = false;

    bool fades_in() const { return streamed && format == FilmFormat::kMp4; }
};

Bytes film_bytes(const Way& way, Clip clip) {
    clip.spec.format = way.format;
    if (way.streamed) return streamed(clip);
    const ScratchFolder folder;
    const fs::path path = folder / "film";
    write_clip(*open_film(clip.spec, path), clip);
    return read_bytes(path, "film");
}

double psnr(const Frame& a, const Frame& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        const double difference = a.rgba[i] - b.rgba[i];
        if (i % 4 != 3) sum += difference * difference;
    }
    return 10 * std::log10(255.0 * 255.0 * 0.75 * static_cast<double>(a.rgba.size()) / sum);
}

// Where the decoded sound lies best against the sweep, in ms, negative when early, and how well it fits
// there.
struct Alignment {
    double offset_ms = 0, correlation = 0;
};

Alignment align(const std::vector<std::int16_t>& decoded, int rate, double sound_s) {
    const int longest_lag = rate / 100, count = static_cast<int>(decoded.size());
    std::vector<double> known(static_cast<std::size_t>(count + 2 * longest_lag));
    for (int k = 0; k < static_cast<int>(known.size()); ++k) {
        const double t = static_cast<double>(k - longest_lag) / rate;
        known[static_cast<std::size_t>(k)] = t < sound_s ? sweep(t) : 0;
    }
    Alignment best;
    for (int lag = -longest_lag; lag <= longest_lag; ++lag) {
        double ab = 0, aa = 1e-9, bb = 1e-9;
        for (int k = 0; k < count; ++k) {
            const double a = known[static_cast<std::size_t>(k + longest_lag - lag)];
            const double b = decoded[static_cast<std::size_t>(k)] / 32767.0;
            ab += a * b;
            aa += a * a;
            bb += b * b;
        }
        const double correlation = ab / std::sqrt(aa * bb);
        if (correlation > best.correlation) best = {1000.0 * lag / rate, correlation};
    }
    return best;
}

double relative_error(const std::vector<std::int16_t>& decoded, int rate, std::size_t from, std::size_t to) {
    double wrong = 0, all = 0;
    for (std::size_t k = from; k < to; ++k) {
        const double known = sweep(static_cast<double>(k) / rate), heard = decoded.at(k) / 32767.0;
        wrong += (heard - known) * (heard - known);
        all += known * known;
    }
    return std::sqrt(wrong / all);
}

std::vector<Frame> frames_of(const Bytes& film, std::vector<double>& times) {
    FrameReader reader{std::span(film)};
    std::vector<Frame> frames;
    while (auto next = reader.next()) {
        frames.push_back(std::move(next->frame));
        times.push_back(next->time_s);
    }
    return frames;
}

class EveryContainer : public testing::TestWithParam<Way> {};

INSTANTIATE_TEST_SUITE_P(Film, EveryContainer,
                         testing::Values(Way{"mp4", FilmFormat::kMp4},
                                         Way{"mp4_stream", FilmFormat::kMp4, true},
                                         Way{"mkv", FilmFormat::kMkv},
                                         Way{"mkv_stream", FilmFormat::kMkv, true}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(EveryContainer, ShowsEveryFrameAtItsTime) {
    for (const FrameRate fps : {FrameRate{30, 1}, FrameRate{30000, 1001}, FrameRate{15, 1}}) {
        Clip clip;
        clip.spec.fps = fps;
        clip.frames = frames_for(clip.samples, clip.spec.sample_rate, fps);
        const Bytes film = film_bytes(GetParam(), clip);
        std::vector<double> times;
        EXPECT_EQ(static_cast<std::int64_t>(frames_of(film, times).size()), clip.frames);
        const double rounding = GetParam().format == FilmFormat::kMkv ? 0.0005 + 1e-9 : 1e-9;
        for (std::size_t n = 0; n < times.size(); ++n) {
            EXPECT_NEAR(times[n], static_cast<double>(n) * fps.denominator / fps.numerator, rounding);
            EXPECT_TRUE(n == 0 || times[n] > times[n - 1]) << n;
        }
    }
}

TEST_P(EveryContainer, KeepsThePicture) {
    const Clip clip;
    std::vector<double> times;
    const auto frames = frames_of(film_bytes(GetParam(), clip), times);
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const Frame drawn = moving_picture(clip.spec.width, clip.spec.height, static_cast<std::int64_t>(n));
        if (GetParam().format == FilmFormat::kMkv) {
            ASSERT_EQ(frames[n].rgba, drawn.rgba) << "frame " << n;
        } else {
            ASSERT_GT(psnr(frames[n], drawn), 36.0) << "frame " << n;
        }
    }
}

TEST_P(EveryContainer, SoundLiesOnTheWaveformFromTheFirstSample) {
    for (const int rate : {16000, 22050, 48000}) {
        Clip clip;
        clip.spec.sample_rate = rate;
        clip.samples = rate * 3 / 2;
        const Bytes film = film_bytes(GetParam(), clip);
        const auto decoded = read_sound(std::span(film), 48000);
        const Alignment found = align(decoded, 48000, 1.5);
        RecordProperty("offset_us_" + std::to_string(rate),
                       static_cast<int>(std::lround(1000 * found.offset_ms)));
        EXPECT_LT(std::abs(found.offset_ms), 1.0) << rate;
        EXPECT_GT(found.correlation, 0.99) << rate;
        // The sweep is loud at once: its first 21 ms, lost to priming, would leave silence. A stream fades
        // in.
        const std::size_t from = GetParam().fades_in() ? 1024 : 0;
        EXPECT_LT(relative_error(decoded, 48000, from, from + 1024), 0.5) << rate;
    }
}

// Another program's idea of the same file.
TEST_P(EveryContainer, SoundLiesOnTheWaveformForFfmpegToo) {
    if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg program here";
    const ScratchFolder folder;
    write_whole(folder / "film", film_bytes(GetParam(), {}));
    const std::string command = "ffmpeg -v quiet -i " + (folder / "film").string() +
                                " -vn -f s16le -ar 48000 -ac 1 " + (folder / "raw").string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    const Bytes raw = read_bytes(folder / "raw", "raw");
    std::vector<std::int16_t> decoded(raw.size() / 2);
    std::memcpy(decoded.data(), raw.data(), 2 * decoded.size());
    const Alignment found = align(decoded, 48000, 1.5);
    EXPECT_LT(std::abs(found.offset_ms), 1.0);
    EXPECT_GT(found.correlation, 0.99);
}

TEST_P(EveryContainer, PictureAndSoundEndTogether) {
    for (const std::int64_t samples : {0, 100, 12345, 23999, 24000}) {
        Clip clip;
        clip.samples = samples;
        const Bytes film = film_bytes(GetParam(), clip);
        std::vector<double> times;
        frames_of(film, times);
        const double picture_s = times.back() + 1.0 / 30;
        const double sound_s = static_cast<double>(read_sound(std::span(film), 48000).size()) / 48000;
        // Matroska rounds to 1 ms; of a stream libav plays the last block of AAC whole.
        EXPECT_NEAR(picture_s, sound_s, GetParam().fades_in() ? 1024.0 / 48000 : 0.0011) << samples;
    }
}

TEST_P(EveryContainer, BytesRepeatAloneAndFourAtOnce) {
    const Bytes once = film_bytes(GetParam(), {});
    EXPECT_EQ(film_bytes(GetParam(), {}), once);
    std::array<Bytes, 4> films;
    std::vector<std::thread> threads;
    for (Bytes& film : films) threads.emplace_back([&] { film = film_bytes(GetParam(), {}); });
    for (std::thread& thread : threads) thread.join();
    for (const Bytes& film : films) EXPECT_EQ(film, once);
}

TEST_P(EveryContainer, BytesDoNotDependOnHowTheSoundIsCut) {
    Clip clip;
    const Bytes whole = film_bytes(GetParam(), clip);
    clip.piece = 37;
    EXPECT_EQ(film_bytes(GetParam(), clip), whole);
    clip.piece = 1 << 20;
    EXPECT_EQ(film_bytes(GetParam(), clip), whole);
}

TEST_P(EveryContainer, TellsNeitherVersionNorSettings) {
    const Bytes film = film_bytes(GetParam(), {});
    const std::string text(film.begin(), film.end());
    EXPECT_EQ(text.find("x264"), std::string::npos);
    EXPECT_EQ(text.find("Lavf5"), std::string::npos);
    EXPECT_EQ(text.find("Lavc5"), std::string::npos);
}

TEST_P(EveryContainer, ReadsRowsStoredBottomFirst) {
    Clip clip;
    clip.spec.format = GetParam().format;
    const ScratchFolder folder;
    for (const std::string name : {"down", "up"}) {
        const auto film = open_film(clip.spec, folder / name);
        Frame frame = moving_picture(clip.spec.width, clip.spec.height, 3);
        if (name == "up") {
            const std::size_t row = 4 * static_cast<std::size_t>(frame.width);
            Bytes flipped;
            for (std::size_t y = static_cast<std::size_t>(frame.height); y-- > 0;) {
                flipped.insert(flipped.end(), frame.rgba.begin() + y * row,
                               frame.rgba.begin() + (y + 1) * row);
            }
            film->add_frame(bottom_up_view(frame.width, frame.height, flipped.data()));
        } else {
            film->add_frame(view(frame));
        }
        film->finish();
    }
    EXPECT_EQ(read_bytes(folder / "up", "film"), read_bytes(folder / "down", "film"));
}

// ---- mp4: boxes ----

struct Box {
    std::string kind;
    std::size_t begin, end;
};

std::vector<Box> boxes(const Bytes& film) {
    std::vector<Box> found;
    for (std::size_t at = 0; at + 8 <= film.size();) {
        const std::size_t size =
            std::size_t{film[at]} << 24 | film[at + 1] << 16 | film[at + 2] << 8 | film[at + 3];
        found.push_back({{film.begin() + at + 4, film.begin() + at + 8}, at, at + size});
        if (size < 8) break;
        at += size;
    }
    return found;
}

TEST(Film, Mp4FileHasItsIndexFirst) {
    std::string order;
    for (const Box& box : boxes(film_bytes({"mp4", FilmFormat::kMp4}, {}))) order += box.kind + " ";
    EXPECT_EQ(order.substr(0, 10), "ftyp moov ");
    EXPECT_NE(order.find("mdat"), std::string::npos);
}

TEST(Film, StreamShowsAndSoundsFromItsFirstFragmentAlone) {
    const Bytes film = streamed({});
    std::vector<std::size_t> moofs;
    for (const Box& box : boxes(film)) {
        if (box.kind == "moof") moofs.push_back(box.begin);
    }
    ASSERT_GT(moofs.size(), 10u);  // 1.5 s in fragments of at most 0.1 s
    const std::span first(film.data(), moofs[1]);
    FrameReader reader{first};
    const auto frame = reader.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->time_s, 0);
    EXPECT_GT(psnr(frame->frame, moving_picture(128, 96, 0)), 36.0);
    const auto sound = read_sound(first, 48000);
    ASSERT_GE(sound.size(), 48000u / 30);                      // as long as the frame is shown
    EXPECT_LT(relative_error(sound, 48000, 1024, 1600), 0.2);  // the first 1024 fade in
}

TEST(Film, StreamSendsAFragmentAsSoonAsItsSoundIsKnown) {
    Clip clip;
    std::mutex mutex;
    std::condition_variable arrived;
    std::size_t bytes = 0;
    const auto film = open_film(clip.spec, [&](std::span<const std::uint8_t> more) {
        const std::lock_guard lock(mutex);
        bytes += more.size();
        arrived.notify_all();
        return true;
    });
    film->add_sound(sweep_samples(16000 / 10, 16000));  // one frame of 33 ms, and 67 ms more
    film->add_frame(view(moving_picture(128, 96, 0)));
    std::unique_lock lock(mutex);
    EXPECT_TRUE(arrived.wait_for(lock, std::chrono::seconds(30), [&] { return bytes > 2000; })) << bytes;
}

// ---- what goes wrong ----

TEST(Film, StopsWhenTheListenerLeaves) {
    const Clip clip;
    int calls_after = 0;
    bool left = false;
    const auto film = open_film(clip.spec, [&](std::span<const std::uint8_t>) {
        if (left) ++calls_after;
        left = true;
        return false;
    });
    const auto sound = sweep_samples(16000, 16000);
    film->add_sound(sound);
    const Frame frame = moving_picture(128, 96, 0);
    std::int64_t taken = 0;
    EXPECT_THROW(
        while (taken < 1000) {
            film->add_frame(view(frame));
            ++taken;
        },
        ClientLeft);
    EXPECT_LT(taken, 30);  // the queue and what one fragment holds, not the film
    EXPECT_THROW(film->add_sound(sound), ClientLeft);
    EXPECT_THROW(film->finish(), ClientLeft);
    EXPECT_EQ(calls_after, 0);
}

TEST(Film, HandsOnWhatTheSinkThrows) {
    const auto film = open_film(
        FilmSpec{}, [](std::span<const std::uint8_t>) -> bool { throw std::out_of_range("the sink's own"); });
    EXPECT_THROW(write_clip(*film, {.spec = FilmSpec{}, .frames = 30, .samples = 16000}), std::out_of_range);
}

TEST(Film, AbandonedLeavesNothingBehind) {
    const ScratchFolder folder;
    for (const FilmFormat format : {FilmFormat::kMp4, FilmFormat::kMkv, FilmFormat::kPng}) {
        FilmSpec spec{128, 96, {30, 1}, format, 16000};
        const auto film = open_film(spec, folder / "film");
        film->add_sound(sweep_samples(16000, 16000));
        for (int n = 0; n < 20; ++n) film->add_frame(view(moving_picture(128, 96, n)));
        EXPECT_FALSE(fs::exists(folder / "film"));
    }
    EXPECT_TRUE(folder.is_empty());
}

TEST(Film, RefusesAFilmWithoutFramesOrWithTooFew) {
    const ScratchFolder folder;
    for (const FilmFormat format : {FilmFormat::kMp4, FilmFormat::kMkv, FilmFormat::kPng}) {
        const FilmSpec spec{128, 96, {30, 1}, format, 16000};
        EXPECT_THROW(open_film(spec, folder / "none")->finish(), std::invalid_argument);
        const auto film = open_film(spec, folder / "few");
        film->add_sound(sweep_samples(16000, 16000));
        film->add_frame(view(moving_picture(128, 96, 0)));
        EXPECT_THROW(film->finish(), std::invalid_argument);
    }
    EXPECT_TRUE(folder.is_empty());
}

TEST(Film, RefusesAFrameOfAnotherSize) {
    const ScratchFolder folder;
    const auto film = open_film({128, 96, {30, 1}, FilmFormat::kMkv, 16000}, folder / "film");
    film->add_frame(view(moving_picture(96, 128, 0)));
    EXPECT_THROW(film->finish(), std::invalid_argument);
}

TEST(Film, NamesAnOutputThatCannotBeWritten) {
    for (const FilmFormat format : {FilmFormat::kMp4, FilmFormat::kMkv, FilmFormat::kPng}) {
        try {
            open_film({128, 96, {30, 1}, format, 16000}, "/nowhere/at/all/film");
            FAIL();
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), "output");
        }
    }
}

TEST(Film, StreamsNoPngFiles) {
    FilmSpec spec;
    spec.format = FilmFormat::kPng;
    EXPECT_THROW(open_film(spec, [](auto) { return true; }), InputError);
}

TEST(Film, AnMkvStreamLeavesAsItIsMade) {
    const FilmSpec spec{128, 96, {30, 1}, FilmFormat::kMkv, 16000};
    std::atomic<std::size_t> sent = 0;
    const auto film = open_film(spec, [&](std::span<const std::uint8_t> more) {
        sent += more.size();
        return true;
    });
    film->add_sound(sweep_samples(48000, 16000));
    for (int n = 0; n < 60; ++n) film->add_frame(view(moving_picture(128, 96, n)));
    EXPECT_GT(sent, std::size_t{10 * 128 * 96});  // of some 50 frames that are through the queue
}

// ---- png ----

TEST(Film, PngFolderHoldsFramesWithAlphaAndSound) {
    const ScratchFolder folder;
    Clip clip{.spec = {33, 17, {30, 1}, FilmFormat::kPng, 16000}, .frames = 5, .samples = 2000};
    write_clip(*open_film(clip.spec, folder / "film"), clip);
    for (int n = 0; n < 5; ++n) {
        FrameReader reader{folder / "film" / ("frame_0000" + std::to_string(n) + ".png")};
        EXPECT_EQ(reader.next()->frame.rgba, moving_picture(33, 17, n).rgba);
    }
    auto sound = sweep_samples(2000, 16000);
    sound.resize(static_cast<std::size_t>(samples_for(5, 16000, {30, 1})));
    EXPECT_EQ(read_sound(folder / "film" / "sound.wav", 16000), sound);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "film"), {}), 6);
    EXPECT_THROW(open_film(clip.spec, folder / "film"), InputError);  // holds a film already
}

TEST(Film, PngKeepsAlpha) {
    const ScratchFolder folder;
    Frame glass = moving_picture(16, 16, 0);
    for (std::size_t i = 3; i < glass.rgba.size(); i += 4) glass.rgba[i] = static_cast<std::uint8_t>(i / 4);
    const auto film = open_film({16, 16, {30, 1}, FilmFormat::kPng, 16000}, folder / "film");
    film->add_frame(view(glass));
    film->finish();
    EXPECT_EQ(FrameReader{folder / "film" / "frame_00000.png"}.next()->frame.rgba, glass.rgba);
}

TEST(Film, MkvSoundIsTheInputExactly) {
    const Clip clip{.spec = {129, 97, {30, 1}, FilmFormat::kMkv, 16000}};  // odd sizes too
    const Bytes film = film_bytes({"mkv", FilmFormat::kMkv}, clip);
    EXPECT_EQ(read_sound(std::span(film), 16000), sweep_samples(clip.samples, 16000));
}

}  // namespace
}  // namespace viaface
