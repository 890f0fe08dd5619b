// Nonsense to be spoken exactly: "ax b:90 aa1:220" are ARPAbet phones, vowels with an optional stress digit,
// each with an optional duration in ms.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "viapoints/phones.hpp"

namespace viaface {

inline constexpr double kShortestPhone = 20, kLongestPhone = 2000;  // ms
inline constexpr std::size_t kMostPhones = 400;                     // of one request
inline constexpr double kLongestPhones = 60000;                     // ms, sum of the durations asked for

struct RequestedPhone {
    PhoneId phone = kPause;
    int stress = 0;
    std::optional<double> duration;  // ms
};

// InputError("phones", item, ...) naming the item and what is allowed. The result starts and ends with a
// pause, holds no two pauses in a row (their durations are added) and at least one other phone.
std::vector<RequestedPhone> parse_phones(std::string_view text);

}  // namespace viaface
