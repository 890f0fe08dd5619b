// Lines of text cut into cells, and cells read as numbers: what motion files in text share. Numbers are read
// and written the same whatever the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viaface {

// What stands before the separator, or all of it; `rest` goes on behind the separator.
std::string_view cut(std::string_view& rest, char separator);
std::string_view cut_line(std::string_view& rest);  // LF or CRLF

std::string_view trimmed(std::string_view text);  // of spaces and tabs at both ends
std::vector<std::string_view> cells_of(std::string_view line, char separator);  // each trimmed

bool is_control(char c);
std::string in_lower_case(std::string_view text);  // A to Z alone

bool is_missing(std::string_view cell);                      // empty, or nan in any case
std::optional<double> finite_number(std::string_view cell);  // the cell as a whole, with a point
void append_number(std::string& text, double value);  // the shortest that reads back equal; NaN: nothing

}  // namespace viaface
