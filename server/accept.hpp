// Which of the types that are offered a client prefers, by its header Accept [RFC 9110, 12.5.1]: of each type
// the quality of the most specific range that holds it; the type of the highest quality above 0, the first
// one among equals. Parameters but q are not looked at, and a range that cannot be read names nothing.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace viaface {

// The first one when nothing is said; none when no type offered is acceptable.
std::optional<std::string_view> preferred_type(std::string_view accept,
                                               std::span<const std::string_view> offered);

}  // namespace viaface
