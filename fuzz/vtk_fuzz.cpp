// Bytes to a scan, which has to be refused by name or read.
#include "base/error.hpp"
#include "facemodel/vtk_polydata.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        viaface::parse_vtk({data, size});
    } catch (const viaface::InputError&) {
        return 0;
    }
    return 0;
}
