// Bytes to a scan, which has to be refused by name or read.
#include "base/error.hpp"
#include "facemodel/gltf_scan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        viaface::parse_gltf_scan({data, size}, [](const std::string& name) -> viaface::Bytes {
            throw viaface::InputError("scan", name, "nothing beside");
        });
    } catch (const viaface::InputError&) {
        return 0;
    }
    return 0;
}
