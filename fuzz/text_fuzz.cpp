// Any bytes become bounded sentences of printable ASCII, or phones, or an InputError.
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "synth/speech/requested_phones.hpp"
#include "synth/speech/text.hpp"

using namespace viaface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        for (const std::string& sentence : sentences(text)) {
            if (sentence.size() > 2000) std::abort();
            for (const char c : sentence) {
                if (c < 0x20 || c > 0x7e) std::abort();
            }
        }
    } catch (const InputError&) {
    }
    try {
        if (parse_phones(text).size() < 3) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
