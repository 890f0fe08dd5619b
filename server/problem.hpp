// Errors as RFC 9457 problem details.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.hpp"

namespace viaface {

inline constexpr const char* kProblemType = "application/problem+json";

struct Problem {
    int status = 500;  // HTTP
    nlohmann::json body;
};

Problem problem(int status, const std::string& title, const std::string& detail);
// 422 with the members field, value and allowed.
Problem problem(const InputError& error);
// What an exception means to a client; only what a client can mend is told in detail.
Problem problem_of(const std::exception& error);

}  // namespace viaface
