// Any bytes are a table, and perhaps a take, or an InputError.
#include "base/error.hpp"
#include "synth/motion/facegood.hpp"
#include "synth/motion/npy.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    try {
        facegood_recording(parse_npy({data, size}));
    } catch (const InputError&) {
    }
    return 0;
}
