#include "server/problem.hpp"

#include "server/admission.hpp"

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
    if (dynamic_cast<const ServiceFull*>(&error) != nullptr)
        return problem(503, "Service Unavailable", error.what());
    return problem(500, "Internal Server Error", "the request failed; the service's log says why");
}

}  // namespace viaface
