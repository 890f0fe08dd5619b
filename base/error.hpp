// Errors of the whole house. Bad input names the field, its value and what is allowed; everything else that
// goes wrong is a std::runtime_error, nested with std::throw_with_nested where context helps.
#pragma once

#include <stdexcept>
#include <string>

namespace viaface {

// What a user can mend. Exit status 2 of the program; HTTP 400, 413, 415 or 422 of the service.
class InputError : public std::runtime_error {
  public:
    InputError(std::string field, std::string value, std::string allowed);

    const std::string& field() const { return field_; }
    const std::string& value() const { return value_; }      // shortened to 80 bytes, printable
    const std::string& allowed() const { return allowed_; }  // a phrase: "10 to 120"

  private:
    std::string field_, value_, allowed_;
};

// "reading x.csv: line 3: ..." : the messages of nested exceptions, outermost first.
std::string describe(const std::exception& error);

}  // namespace viaface
