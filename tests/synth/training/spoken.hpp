// Phones with lengths, written as text: "pau:200 aa1:150 b:90".
#pragma once

#include <sstream>
#include <string>

#include "viapoints/phones.hpp"

namespace viaface::testing {

inline PhoneSequence spoken(const std::string& text) {
    PhoneSequence sequence;
    std::istringstream in(text);
    std::int64_t at = 0;
    for (std::string item; in >> item;) {
        const std::size_t colon = item.find(':');
        const StressedPhone phone = parse_phone(item.substr(0, colon));
        const std::int64_t length = std::stoll(item.substr(colon + 1)) * sequence.sample_rate / 1000;
        sequence.phones.push_back({phone.phone, phone.stress, at, at + length});
        at += length;
    }
    return sequence;
}

}  // namespace viaface::testing
