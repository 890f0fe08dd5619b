// Any bytes are a recording or an InputError; and a recording written is the same text when read and written
// again.
#include <cstdlib>

#include "base/error.hpp"
#include "viapoints/motion_trc.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    try {
        const std::string written = format_trc(parse_trc({reinterpret_cast<const char*>(data), size}));
        if (format_trc(parse_trc(written)) != written) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
