#include "server/problem.hpp"

#include <cstdio>

#include "server/admission.hpp"
#include "server/json_fields.hpp"

namespace viaface {
namespace {

// Texts of strangers may hold half a character; JSON may not.
std::string utf8(const std::string& text) {
    const auto dumped = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return nlohmann::json::parse(dumped).get<std::string>();
}

}  // namespace

Problem problem(int status, const std::string& title, const std::string& detail) {
    return {status,
            {{"type", "about:blank"}, {"title", title}, {"status", status}, {"detail", utf8(detail)}}};
}

Problem problem(const InputError& error) {
    Problem result = problem(422, "Unprocessable Content", error.what());
    result.body["field"] = utf8(error.field());
    result.body["value"] = utf8(error.value());
    result.body["allowed"] = utf8(error.allowed());
    return result;
}

Problem problem_of(const std::exception& error) {
    if (const auto* input = dynamic_cast<const InputError*>(&error)) return problem(*input);
    if (const auto* http = dynamic_cast<const HttpError*>(&error))
        return problem(http->status(), http->title(), http->what());
    if (dynamic_cast<const NotJson*>(&error) != nullptr) return problem(400, "Bad Request", error.what());
    if (dynamic_cast<const ServiceFull*>(&error) != nullptr)
        return problem(503, "Service Unavailable", error.what());
    return problem(500, "Internal Server Error", "the request failed; the service's log says why");
}

void log_failure(const std::exception& error) {
    std::fprintf(stderr, "viaface: %s\n", describe(error).c_str());
}

}  // namespace viaface
