// Bytes to a face, which has to be refused by name or read.
#include "base/error.hpp"
#include "facemodel/gltf.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        viaface::read_glb({data, size});
    } catch (const viaface::InputError&) {
        return 0;
    }
    return 0;
}
