#include "server/json_fields.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr double kLargestExact = 9007199254740992;  // 2^53: beyond, a double does not tell which

std::string shown(const nlohmann::json& value) {
    return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

nlohmann::json parse_json(std::string_view text) {
    using Event = nlohmann::json::parse_event_t;
    const auto shallow = [](int depth, Event event, nlohmann::json&) {
        const bool opens = event == Event::object_start || event == Event::array_start;
        if (opens && depth >= kDeepestJson)
            throw NotJson("nested more than " + std::to_string(kDeepestJson) + " deep, which no request is");
        return true;
    };
    try {
        return nlohmann::json::parse(text, shallow);
    } catch (const nlohmann::json::exception& error) {
        throw NotJson(error.what());
    }
}

JsonFields::JsonFields(const nlohmann::json& object, std::string path)
    : object_(object), path_(std::move(path)) {
    if (!object.is_object()) throw InputError(path_.empty() ? "body" : path_, shown(object), "a JSON object");
}

const nlohmann::json* JsonFields::find(const std::string& name) {
    asked_.push_back(name);
    const auto found = object_.find(name);
    return found == object_.end() ? nullptr : &*found;
}

void JsonFields::refuse(const std::string& name, const std::string& allowed) const {
    throw InputError(path_of(name), shown(object_.at(name)), allowed);
}

std::optional<std::string> JsonFields::text(const std::string& name) {
    const auto* value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_string()) refuse(name, "a string");
    return value->get<std::string>();
}

std::optional<double> JsonFields::number(const std::string& name) {
    const auto* value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number()) refuse(name, "a number");
    return value->get<double>();
}

std::optional<bool> JsonFields::flag(const std::string& name) {
    const auto* value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_boolean()) refuse(name, "true or false");
    return value->get<bool>();
}

std::optional<std::uint64_t> JsonFields::whole_number(const std::string& name) {
    const auto* value = find(name);
    if (value == nullptr) return std::nullopt;
    if (value->is_number_unsigned()) return value->get<std::uint64_t>();
    const double number = value->is_number_float() ? value->get<double>() : -1;  // 7.0 and 7e0 are whole
    if (!(number >= 0 && number <= kLargestExact && number == std::floor(number)))
        refuse(name, "a whole number from 0");
    return static_cast<std::uint64_t>(number);
}

std::optional<nlohmann::json> JsonFields::object(const std::string& name) {
    const auto* value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_object()) refuse(name, "a JSON object");
    return *value;
}

void JsonFields::refuse_unknown() const {
    for (const auto& [name, value] : object_.items()) {
        if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
        std::string known;
        for (const auto& field : asked_) known += (known.empty() ? "" : ", ") + field;
        throw InputError(path_of(name), shown(value), "only the fields " + known);
    }
}

}  // namespace viaface
