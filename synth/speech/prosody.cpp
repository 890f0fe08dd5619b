#include "synth/speech/prosody.hpp"

#include <string>

#include "base/error.hpp"

namespace viaface {
namespace {

void check_factor(const char* field, double value) {
    if (!(value >= kLeast && value <= kMost)) throw InputError(field, std::to_string(value), "0.5 to 2");
}

}  // namespace

void check_prosody(const Prosody& prosody) {
    check_factor("rate", prosody.rate);
    check_factor("pitch", prosody.pitch);
}

}  // namespace viaface
