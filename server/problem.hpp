// Errors as RFC 9457 problem details.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "base/error.hpp"

namespace viaface {

inline constexpr const char* kProblemType = "application/problem+json";

// Told to the client as it is.
class HttpError : public std::runtime_error {
  public:
    HttpError(int status, std::string title, const std::string& detail)
        : std::runtime_error(detail), status_(status), title_(std::move(title)) {}

    int status() const { return status_; }
    const std::string& title() const { return title_; }

  private:
    int status_;
    std::string title_;
};

struct Problem {
    int status = 500;  // HTTP
    nlohmann::json body;
};

Problem problem(int status, const std::string& title, const std::string& detail);
// 422 with the members field, value and allowed.
Problem problem(const InputError& error);
// What an exception means to a client; only what a client can mend is told in detail.
Problem problem_of(const std::exception& error);
// What a client is not told, to stderr.
void log_failure(const std::exception& error);

}  // namespace viaface
