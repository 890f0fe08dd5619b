#include "synth/speech/requested_phones.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";

double parse_duration(std::string_view item, std::string_view number) {
    double duration = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), duration);
    const bool whole = error == std::errc() && end == number.data() + number.size();
    if (!whole || !(duration >= kShortestPhone && duration <= kLongestPhone)) {
        throw InputError("phones", std::string(item),
                         "a duration of 20 to 2000 ms after the colon, such as b:90");
    }
    return duration;
}

RequestedPhone parse_item(std::string_view item) {
    const std::size_t colon = item.find(':');
    RequestedPhone requested;
    try {
        const StressedPhone phone = parse_phone(item.substr(0, colon));
        requested = {phone.phone, phone.stress, std::nullopt};
    } catch (const InputError& error) {
        const bool ascii = std::all_of(item.begin(), item.end(), [](unsigned char c) { return c < 0x80; });
        throw InputError("phones", ascii ? std::string(item) : "(not ASCII)", error.allowed());
    }
    if (colon != std::string_view::npos) requested.duration = parse_duration(item, item.substr(colon + 1));
    return requested;
}

std::vector<RequestedPhone> parse_items(std::string_view text) {
    std::vector<RequestedPhone> phones;
    for (std::size_t at = text.find_first_not_of(kSpaces); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kSpaces, at), text.size());
        phones.push_back(parse_item(text.substr(at, end - at)));
        if (phones.size() > kMostPhones) {
            throw InputError("phones", "more than 400 phones", "at most 400 phones");
        }
        at = text.find_first_not_of(kSpaces, end);
    }
    return phones;
}

void check_total(const std::vector<RequestedPhone>& phones) {
    double total = 0;
    for (const RequestedPhone& phone : phones) total += phone.duration.value_or(0);
    if (total > kLongestPhones) {
        throw InputError("phones", std::to_string(static_cast<long>(total)) + " ms in all",
                         "at most 60000 ms in all");
    }
}

void append_pause(std::vector<RequestedPhone>& phones, const RequestedPhone& pause) {
    if (phones.empty() || phones.back().phone != kPause) {
        phones.push_back(pause);
    } else if (pause.duration) {
        phones.back().duration = phones.back().duration.value_or(0) + *pause.duration;
    }
}

}  // namespace

std::vector<RequestedPhone> parse_phones(std::string_view text) {
    const std::vector<RequestedPhone> items = parse_items(text);
    check_total(items);
    if (std::all_of(items.begin(), items.end(), [](const auto& item) { return item.phone == kPause; })) {
        throw InputError("phones", items.empty() ? "" : "only pauses",
                         "at least one phone, such as \"ax b:90 aa1:220\"");
    }
    std::vector<RequestedPhone> phones = {{}};
    for (const RequestedPhone& item : items) {
        if (item.phone == kPause) {
            append_pause(phones, item);
        } else {
            phones.push_back(item);
        }
    }
    append_pause(phones, {});
    return phones;
}

}  // namespace viaface
