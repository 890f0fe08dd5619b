// Bytes to a scan, which has to be refused by name or read.
#include "base/error.hpp"
#include "facemodel/range_scan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        viaface::range_surface(viaface::parse_pgm({data, size}), {0.1, 0, 360, 0, 100, 0.1});
    } catch (const viaface::InputError&) {
        return 0;
    }
    return 0;
}
