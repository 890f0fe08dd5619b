#include "synth/align/recording.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "base/error.hpp"
#include "synth/align/phone_decoder.hpp"
#include "synth/film/film_spec.hpp"
#include "synth/film/media_reader.hpp"

namespace viaface {
namespace {

constexpr int kQuietestPeak = 32;  // of 32768: 60 dB below the loudest there is

bool is_silent(const std::vector<std::int16_t>& samples) {
    return std::all_of(samples.begin(), samples.end(), [](int s) { return std::abs(s) < kQuietestPeak; });
}

void check(const MonoSound& sound, const std::string& name, const std::string& field) {
    const auto refuse = [&](const std::string& what, const std::string& allowed) {
        throw InputError(field, name + ": " + what, allowed);
    };
    if (sound.samples.empty()) refuse("no sound", "a recording of speech");
    if (sound.rate < kLowestSampleRate || sound.rate > kHighestSampleRate)
        refuse(std::to_string(sound.rate) + " Hz", "8000 to 192000 Hz");
    const double seconds = static_cast<double>(sound.samples.size()) / sound.rate;
    if (seconds > kLongestRecording) {
        refuse((std::ostringstream() << seconds << " s").str(),
               "a recording of at most 600 s; cut it at pauses");
    }
    if (is_silent(sound.samples)) refuse("silence", "a recording of speech");
}

}  // namespace

Recording read_recording(const std::filesystem::path& file, const std::string& field) {
    const std::string name = file.filename().string();
    try {
        MonoSound own = read_sound(file);
        check(own, name, field);
        return {{own.rate, std::move(own.samples)}, read_sound(file, kDecoderRate)};
    } catch (const InputError& error) {
        if (error.field() == field) throw;
        throw InputError(field, name + ": " + error.value(), error.allowed());
    }
}

Recording recording_of(Waveform sound) {
    if (sound.sample_rate != kDecoderRate) throw std::invalid_argument("recording_of: a sound of 16 kHz");
    std::vector<std::int16_t> same = sound.samples;
    return {std::move(sound), std::move(same)};
}

}  // namespace viaface
