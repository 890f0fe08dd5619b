// What is read as a TextGrid is written and read again as the same.
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "synth/speech/text_grid.hpp"

using namespace viaface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const TextGrid grid = read_text_grid({reinterpret_cast<const char*>(data), size});
        const std::string written = write_text_grid(grid);
        if (write_text_grid(read_text_grid(written)) != written) std::abort();
        phones_of(grid, 16000);
    } catch (const InputError&) {
    }
    return 0;
}
