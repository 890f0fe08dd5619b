// Any bytes are points or an InputError, and so are their places in the layout.
#include "base/error.hpp"
#include "viapoints/point_csv.hpp"
#include "viapoints/point_names.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    try {
        lay_out(parse_point_csv({reinterpret_cast<const char*>(data), size}, "motion", "mm"));
    } catch (const InputError&) {
    }
    return 0;
}
