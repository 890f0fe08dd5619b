#include "facemodel/scan_words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace viaface {
namespace {

bool is_space(std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void ScanWords::skip_space() {
    while (offset_ < bytes_.size() && is_space(bytes_[offset_])) ++offset_;
}

bool ScanWords::at_end() {
    skip_space();
    return offset_ == bytes_.size();
}

std::string_view ScanWords::line() {
    if (left() == 0) fail("the end of the file", "more lines");
    const std::size_t begin = offset_;
    while (offset_ < bytes_.size() && bytes_[offset_] != '\n') ++offset_;
    std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + begin, offset_ - begin);
    if (offset_ < bytes_.size()) ++offset_;
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
}

std::string_view ScanWords::word() {
    if (at_end()) fail("the end of the file", "more words");
    const std::size_t begin = offset_;
    while (offset_ < bytes_.size() && !is_space(bytes_[offset_])) ++offset_;
    return {reinterpret_cast<const char*>(bytes_.data()) + begin, offset_ - begin};
}

double ScanWords::number() {
    const std::string_view text = word();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        fail(std::string(text), "a finite number");
    return value;
}

long ScanWords::whole(long low, long high) {
    const std::string_view text = word();
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < low || value > high)
        fail(std::string(text), std::to_string(low) + " to " + std::to_string(high));
    return value;
}

bool ScanWords::next_is(std::string_view wanted) {
    const std::size_t before = offset_;
    const bool same = !at_end() && lower(word()) == lower(wanted);
    offset_ = before;
    return same;
}

void ScanWords::skip_words(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) word();
}

std::span<const std::uint8_t> ScanWords::take(std::size_t count) {
    if (count > left()) fail("the end of the file", std::to_string(count) + " more bytes");
    const auto taken = bytes_.subspan(offset_, count);
    offset_ += count;
    return taken;
}

void ScanWords::fail(const std::string& value, const std::string& allowed) const {
    const auto lines =
        std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(offset_), '\n');
    throw InputError("scan",
                     "line " + std::to_string(lines + 1) + ", byte " + std::to_string(offset_) + ": " + value,
                     allowed);
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

}  // namespace viaface
