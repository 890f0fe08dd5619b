#include "viapoints/cells.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace viaface {

Lines::Lines(std::string_view text, std::string field) : rest_(text), field_(std::move(field)) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool Lines::next() {
    if (rest_.empty()) return false;
    ++number_;
    line_ = cut(rest_, '\n');
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    return true;
}

void Lines::fail(std::string_view column, std::string_view value, const std::string& allowed) const {
    std::string where = field_ + " line " + std::to_string(number_);
    if (!column.empty()) where += ", column " + std::string(column);
    throw InputError(where, std::string(value), allowed);
}

std::string_view cut(std::string_view& rest, char separator) {
    const std::size_t at = std::min(rest.find(separator), rest.size());
    const std::string_view piece = rest.substr(0, at);
    rest.remove_prefix(std::min(at + 1, rest.size()));
    return piece;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    for (bool more = true; more;) {
        more = line.find(separator) != line.npos;
        cells.push_back(trimmed(cut(line, separator)));
    }
    return cells;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

bool is_missing(std::string_view cell) { return cell.empty() || in_lower_case(cell) == "nan"; }

std::optional<double> finite_number(std::string_view cell) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

void append_number(std::string& text, double value) {
    if (std::isnan(value)) return;
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace viaface
