// Text to a scan, which has to be refused by name or read, and to the pictures of materials.
#include "base/error.hpp"
#include "facemodel/obj.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    viaface::parse_mtl(text);
    try {
        viaface::parse_obj(text);
    } catch (const viaface::InputError&) {
        return 0;
    }
    return 0;
}
