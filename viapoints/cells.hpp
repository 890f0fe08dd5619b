// Lines of text cut into cells, and cells read as numbers: what motion files in text share. Numbers are read
// and written the same whatever the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viaface {

// The lines of a text, counted from 1 (LF or CRLF; a byte-order mark is left out), and errors that name them.
class Lines {
  public:
    Lines(std::string_view text, std::string field);

    bool next();  // false at the end
    std::string_view line() const { return line_; }
    std::size_t number() const { return number_; }
    void go_to(std::size_t number) { number_ = number; }  // for an error about a line gone by

    // InputError: "field line 3, column chin_x_mm"; column may be empty.
    [[noreturn]] void fail(std::string_view column, std::string_view value, const std::string& allowed) const;

  private:
    std::string_view rest_, line_;
    std::string field_;
    std::size_t number_ = 0;
};

// What stands before the separator, or all of it; `rest` goes on behind the separator.
std::string_view cut(std::string_view& rest, char separator);

std::string_view trimmed(std::string_view text);  // of spaces and tabs at both ends
std::vector<std::string_view> cells_of(std::string_view line, char separator);  // each trimmed

bool is_control(char c);
std::string in_lower_case(std::string_view text);  // A to Z alone

bool is_missing(std::string_view cell);                      // empty, or nan in any case
std::optional<double> finite_number(std::string_view cell);  // the cell as a whole, with a point
void append_number(std::string& text, double value);  // the shortest that reads back equal; NaN: nothing

}  // namespace viaface
