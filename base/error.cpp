#include "base/error.hpp"

namespace viaface {
namespace {

std::string printable(const std::string& value) {
    constexpr std::size_t kLongest = 80;
    std::string shown;
    for (const char c : value.substr(0, kLongest)) {
        const auto byte = static_cast<unsigned char>(c);
        shown += (byte < 0x20 || byte == 0x7f) ? '?' : c;
    }
    while (value.size() > kLongest && !shown.empty() && (static_cast<unsigned char>(shown.back()) & 0x80)) {
        shown.pop_back();
    }
    return value.size() > kLongest ? shown + "..." : shown;
}

}  // namespace

InputError::InputError(std::string field, std::string value, std::string allowed)
    : std::runtime_error(field + ": \"" + printable(value) + "\" is not allowed; allowed: " + allowed),
      field_(std::move(field)),
      value_(printable(value)),
      allowed_(std::move(allowed)) {}

std::string describe(const std::exception& error) {
    try {
        std::rethrow_if_nested(error);
    } catch (const std::exception& inner) {
        return std::string(error.what()) + ": " + describe(inner);
    }
    return error.what();
}

}  // namespace viaface
