// Any bytes are a take whose times rise, or an InputError.
#include <cstdlib>

#include "base/error.hpp"
#include "synth/motion/live_link.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    try {
        const BlendRecording take = parse_live_link({reinterpret_cast<const char*>(data), size});
        for (std::size_t i = 1; i < take.time_s.size(); ++i) {
            if (!(take.time_s[i] > take.time_s[i - 1])) std::abort();
        }
    } catch (const InputError&) {
    }
    return 0;
}
