// Words and numbers of scan files, in text and in binary, with every bound checked. Errors name the line of a
// text, or the byte offset.
#pragma once

#include <bit>
#include <concepts>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "base/bytes.hpp"

namespace viaface {

class ScanWords {
  public:
    explicit ScanWords(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool at_end();            // nothing but white space is left
    std::string_view line();  // up to the next line's begin, without its end; from a line's begin
    std::string_view word();  // fails at the end
    double number();          // finite
    long whole(long low, long high);
    bool next_is(std::string_view word);  // looks ahead
    void skip_words(std::size_t count);

    template <class T>
    T binary(std::endian order) {
        std::array<std::uint8_t, sizeof(T)> raw;
        const auto taken = take(sizeof(T));
        for (std::size_t k = 0; k < sizeof(T); ++k)
            raw[order == std::endian::native ? k : sizeof(T) - 1 - k] = taken[k];
        return std::bit_cast<T>(raw);
    }
    std::span<const std::uint8_t> take(std::size_t count);
    std::size_t left() const { return bytes_.size() - offset_; }

    [[noreturn]] void fail(const std::string& value, const std::string& allowed) const;

  private:
    void skip_space();

    std::span<const std::uint8_t> bytes_;
    std::size_t offset_ = 0;
};

std::string lower(std::string_view text);  // ASCII

}  // namespace viaface
