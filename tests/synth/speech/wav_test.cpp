#include "synth/speech/wav.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace viaface {
namespace {

Waveform ramp() {
    Waveform sound{22050, {}};
    for (int i = 0; i < 1001; ++i) sound.samples.push_back(static_cast<std::int16_t>(i * 65 - 32768));
    return sound;
}

TEST(Wav, ReadsBackWhatWasWritten) {
    const Waveform sound = ramp();
    const Bytes bytes = write_wav(sound);
    EXPECT_EQ(bytes.size(), 44 + 2 * sound.samples.size());
    const Waveform read = read_wav(bytes);
    EXPECT_EQ(read.sample_rate, sound.sample_rate);
    EXPECT_EQ(read.samples, sound.samples);
}

TEST(Wav, ReadsOverOtherChunks) {
    Bytes bytes = write_wav(ramp());
    const Bytes other = {'L', 'I', 'S', 'T', 3, 0, 0, 0, 'a', 'b', 'c', 0};  // padded to an even size
    bytes.insert(bytes.begin() + 36, other.begin(), other.end());
    EXPECT_EQ(read_wav(bytes).samples, ramp().samples);
}

TEST(Wav, EveryTruncationIsRefused) {
    const Bytes bytes = write_wav(ramp());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THROW(read_wav(std::span(bytes).first(size)), InputError) << size;
    }
}

TEST(Wav, OtherFormatsAreRefusedByName) {
    struct Change {
        std::size_t offset;
        std::uint8_t value;
    };
    for (const auto& [offset, value] : {Change{0, 'X'}, Change{8, 'X'}, Change{20, 3}, Change{22, 2},
                                        Change{34, 24}, Change{26, 0xff}, Change{12, 'X'}}) {
        Bytes bytes = write_wav(ramp());
        bytes[offset] = value;
        try {
            read_wav(bytes);
            ADD_FAILURE() << offset;
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), "sound");
        }
    }
}

}  // namespace
}  // namespace viaface
