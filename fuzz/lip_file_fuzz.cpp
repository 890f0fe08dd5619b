// Bytes to a lip model, which has to be refused by name or written again as the same bytes.
#include <algorithm>
#include <cstdlib>

#include "base/error.hpp"
#include "lipmodel/lip_file.hpp"

namespace {

// With the checksum put right, so that what lies behind it is reached.
viaface::Bytes sealed(std::span<const std::uint8_t> bytes) {
    viaface::Bytes made(bytes.begin(), bytes.end());
    if (made.size() < 4) return made;
    const std::uint32_t crc = viaface::crc32(std::span(made).first(made.size() - 4));
    for (int i = 0; i < 4; ++i) made[made.size() - 4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const viaface::Bytes bytes = sealed({data, size});
    try {
        const viaface::LipModel model = viaface::read_lip_model(bytes);
        if (viaface::write_lip_model(model) != bytes) std::abort();
    } catch (const viaface::InputError&) {
        return 0;
    }
    return 0;
}
