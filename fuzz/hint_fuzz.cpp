// A hint that is taken has two eyes apart and, if it has one, a mouth with a size.
#include <cstdint>
#include <cstdlib>

#include "base/error.hpp"
#include "synth/track/hint.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto hint = viaface::parse_hint({reinterpret_cast<const char*>(data), size});
        if (!(hint.face.eye_distance() >= 4)) std::abort();
        if (hint.mouth && !(hint.mouth->width > 0 && hint.mouth->height > 0)) std::abort();
    } catch (const viaface::InputError&) {
    }
    return 0;
}
