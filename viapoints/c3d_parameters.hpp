// The parameter section of a C3D file: groups of named arrays (c3d.org, The C3D File Format, "The Parameter
// Section"). A record is: i8 length of the name (negative: locked), i8 number (negative: a group's),
// the name, u16 distance from itself to the next record (0: the last), and for a parameter i8 type (-1
// characters, 1 bytes, 2 words, 4 floats), u8 dimensions, their u8 sizes, the values; then u8 length of the
// description and the description. Groups may come after their parameters. Names are read in any case.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viapoints/c3d_bytes.hpp"

namespace viaface {

struct C3dParameter {
    std::vector<std::string> texts;  // of characters: rows of the first dimension, trimmed at their ends
    std::vector<double> numbers;     // of bytes, words (unsigned) and floats
};

class C3dParameters {
  public:
    // Sets the processor of `bytes`. InputError for a section that is none.
    C3dParameters(C3dBytes& bytes, std::size_t start);

    std::optional<double> number(const std::string& name, std::size_t index = 0) const;  // "POINT:RATE"
    const std::vector<std::string>& texts(const std::string& name) const;                // none when absent
    std::size_t last() const { return last_; }  // where the last record begins in the file

  private:
    std::map<std::string, C3dParameter> all_;  // by "GROUP:NAME"
    std::size_t last_ = 0;
};

}  // namespace viaface
