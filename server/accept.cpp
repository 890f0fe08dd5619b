#include "server/accept.hpp"

#include <algorithm>
#include <charconv>

#include "viapoints/cells.hpp"

namespace viaface {
namespace {

// What is before the separator; `text` keeps what is behind it.
std::string_view next_part(std::string_view& text, char separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return trimmed(part);
}

bool same(std::string_view a, std::string_view b) { return in_lower_case(a) == in_lower_case(b); }

// A range's quality, 1 when it tells none; none for what is no number from 0 to 1.
std::optional<double> quality_of(std::string_view parameters) {
    while (!parameters.empty()) {
        std::string_view value = next_part(parameters, ';');
        if (!same(next_part(value, '='), "q")) continue;
        double quality = 0;
        const auto [end, error] =
            std::from_chars(value.data(), value.data() + value.size(), quality, std::chars_format::fixed);
        if (error != std::errc() || end != value.data() + value.size() || !(quality >= 0 && quality <= 1))
            return std::nullopt;
        return quality;
    }
    return 1;
}

// 3: the type itself, 2: all of its kind, 1: all, 0: another.
int fit(std::string_view range, std::string_view type) {
    if (same(range, type)) return 3;
    if (range == "*/*") return 1;
    return range.ends_with("/*") &&
                   same(range.substr(0, range.size() - 1), type.substr(0, type.find('/') + 1))
               ? 2
               : 0;
}

double quality_for(std::string_view accept, std::string_view type) {
    int best = 0;
    double quality = 0;
    while (!accept.empty()) {
        std::string_view parameters = next_part(accept, ',');
        const int fits = fit(next_part(parameters, ';'), type);
        if (fits <= best) continue;
        const auto told = quality_of(parameters);
        if (!told) continue;
        best = fits;
        quality = *told;
    }
    return quality;
}

}  // namespace

std::optional<std::string_view> preferred_type(std::string_view accept,
                                               std::span<const std::string_view> offered) {
    if (trimmed(accept).empty()) return offered.front();
    std::optional<std::string_view> preferred;
    double highest = 0;
    for (const std::string_view type : offered) {
        const double quality = quality_for(accept, type);
        if (quality <= highest) continue;
        highest = quality;
        preferred = type;
    }
    return preferred;
}

}  // namespace viaface
