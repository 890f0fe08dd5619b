// Whatever a client says that it accepts, what it is given is one of what is offered.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "server/accept.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::array<std::string_view, 2> kOffered = {"application/json", "application/vnd.viaface.via"};
    const auto type = viaface::preferred_type({reinterpret_cast<const char*>(data), size}, kOffered);
    if (type && std::ranges::find(kOffered, *type) == kOffered.end()) std::abort();
    return 0;
}
