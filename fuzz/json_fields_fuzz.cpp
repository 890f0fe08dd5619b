// What is read as JSON is asked for as every type of field; what it is not is an error that can be shown.
#include <cstdint>
#include <cstdlib>

#include "base/error.hpp"
#include "server/json_fields.hpp"

using namespace viaface;

namespace {

template <class Ask>
void ask(Ask asked) {
    try {
        asked();
    } catch (const InputError& error) {
        if (std::string_view(error.what()).empty()) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto json = parse_json({reinterpret_cast<const char*>(data), size});
        ask([&] {
            JsonFields fields(json, "");
            ask([&] { fields.text("text"); });
            ask([&] { fields.number("fps"); });
            ask([&] { fields.whole_number("seed"); });
            ask([&] { fields.object("view"); });
            fields.refuse_unknown();
        });
    } catch (const NotJson&) {
    }
    return 0;
}
