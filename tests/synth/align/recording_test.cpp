#include "synth/align/recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/speech/wav.hpp"
#include "tests/scratch_folder.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

class RecordingTest : public testing::Test {
  protected:
    fs::path written(const Waveform& sound) const {
        const Bytes bytes = write_wav(sound);
        write_whole(folder_ / "a.wav", std::span(bytes));
        return folder_ / "a.wav";
    }
    void expect_refused(const fs::path& file, const std::string& about) const {
        try {
            read_recording(file, "audio");
            ADD_FAILURE() << about;
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), "audio");
            EXPECT_NE(error.value().find(file.filename().string()), std::string::npos) << error.value();
            EXPECT_NE(std::string(error.what()).find(about), std::string::npos) << error.what();
        }
    }

    const test::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

Waveform tone(int rate, double seconds) {
    Waveform sound{rate, {}};
    for (int i = 0; i < seconds * rate; ++i)
        sound.samples.push_back(static_cast<std::int16_t>(std::lround(8000 * std::sin(2765.0 * i / rate))));
    return sound;
}

TEST_F(RecordingTest, KeepsEverySampleAtItsOwnRate) {
    for (const int rate : {8000, 22050, 44100, 48000}) {
        const Waveform sound = tone(rate, 0.7);
        const Recording recording = read_recording(written(sound), "audio");
        EXPECT_EQ(recording.sound.sample_rate, rate);
        EXPECT_EQ(recording.sound.samples, sound.samples);
        EXPECT_EQ(recording.at_16_khz.size(), sound.samples.size() * 16000 / static_cast<std::size_t>(rate));
    }
}

TEST_F(RecordingTest, RefusesWhatHoldsNoSpeech) {
    expect_refused(written({16000, {}}), "");
    expect_refused(written({16000, std::vector<std::int16_t>(16000, 0)}), "silence");
    expect_refused(written(tone(4000, 1)), "8000 to 192000 Hz");
    expect_refused(written({8000, std::vector<std::int16_t>(8000 * 601, 99)}), "600 s");
    expect_refused(written({8000, std::vector<std::int16_t>(8000 * 1810, 99)}), "minutes");
    write_whole(folder_ / "b.wav", std::string_view("no sound"));
    expect_refused(folder_ / "b.wav", "");
    expect_refused(folder_ / "none.wav", "");
}

}  // namespace
}  // namespace viaface
