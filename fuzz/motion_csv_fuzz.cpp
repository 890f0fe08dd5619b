// Any bytes are a motion or an InputError; and a motion written is the same text when read and written again.
#include <cstdlib>
#include <span>

#include "base/error.hpp"
#include "viapoints/motion_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    MotionCsv csv;
    try {
        csv = parse_motion_csv({reinterpret_cast<const char*>(data), size});
    } catch (const InputError&) {
        return 0;
    }
    const std::string written = format_motion_csv(csv.motion, csv.comments);
    const MotionCsv again = parse_motion_csv(written);
    if (format_motion_csv(again.motion, again.comments) != written) std::abort();
    return 0;
}
