// Any bytes are a recording or an InputError; and what is read with even times can be written and read again.
#include <cstdlib>

#include "base/error.hpp"
#include "viapoints/motion_c3d.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    try {
        const PointRecording read = parse_c3d({data, size});
        if (read.size() < 2) return 0;
        const PointRecording again = parse_c3d(format_c3d(read));
        if (again.size() != read.size() || again.labels.size() != read.labels.size()) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
