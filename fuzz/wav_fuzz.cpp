// What is read as a WAV is written and read again as the same.
#include <cstdlib>

#include "base/error.hpp"
#include "synth/speech/wav.hpp"

using namespace viaface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const Waveform sound = read_wav({data, size});
        const Waveform again = read_wav(write_wav(sound));
        if (again.samples != sound.samples || again.sample_rate != sound.sample_rate) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
