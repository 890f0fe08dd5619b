#include "tests/server/schema_check.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

namespace viaface {
namespace {

using nlohmann::json;

bool has_type(const std::string& type, const json& value) {
    if (type == "integer" && value.is_number_float()) return value == std::floor(value.get<double>());
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return type == value.type_name();
}

std::size_t characters(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

std::vector<std::string> SchemaCheck::faults(const json& schema, const json& value) const {
    SchemaCheck once(root_);
    once.check(schema, value, "");
    return once.faults_;
}

void SchemaCheck::check(const json& schema, const json& value, const std::string& at) const {
    for (const auto& [keyword, allowed] : schema.items()) check_keyword(keyword, allowed, value, at);
    if (value.is_object()) check_object(schema, value, at);
    if (value.is_array()) check_array(schema, value, at);
}

void SchemaCheck::check_object(const json& schema, const json& value, const std::string& at) const {
    const json known = schema.value("properties", json::object());
    for (const auto& [name, member] : value.items()) {
        if (known.contains(name)) {
            check(known[name], member, at + "/" + name);
        } else if (schema.contains("additionalProperties")) {
            faults_.push_back(at + ": has " + name);
        }
    }
    for (const auto& name : schema.value("required", json::array())) {
        if (!value.contains(name)) faults_.push_back(at + ": lacks " + name.get<std::string>());
    }
}

void SchemaCheck::check_array(const json& schema, const json& value, const std::string& at) const {
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < value.size(); ++i)
        check(schema["items"], value[i], at + "/" + std::to_string(i));
}

int SchemaCheck::fitting(const json& schemas, const json& value) const {
    return static_cast<int>(std::count_if(schemas.begin(), schemas.end(),
                                          [&](const json& schema) { return faults(schema, value).empty(); }));
}

void SchemaCheck::check_keyword(const std::string& keyword, const json& allowed, const json& value,
                                const std::string& at) const {
    static const std::set<std::string> kElsewhere = {"properties", "required",    "items",
                                                     "default",    "description", "examples"};
    if (kElsewhere.contains(keyword)) return;
    bool fits = false;
    if (keyword == "$ref") {
        return check(root_.at(json::json_pointer(allowed.get<std::string>().substr(1))), value, at);
    } else if (keyword == "type") {
        fits = has_type(allowed, value);
    } else if (keyword == "enum") {
        fits = std::find(allowed.begin(), allowed.end(), value) != allowed.end();
    } else if (keyword == "const") {
        fits = value == allowed;
    } else if (keyword == "minimum") {
        fits = !value.is_number() || value >= allowed;
    } else if (keyword == "maximum") {
        fits = !value.is_number() || value <= allowed;
    } else if (keyword == "minLength") {
        fits = !value.is_string() || characters(value) >= allowed.get<std::size_t>();
    } else if (keyword == "maxLength") {
        fits = !value.is_string() || characters(value) <= allowed.get<std::size_t>();
    } else if (keyword == "pattern") {
        fits = !value.is_string() ||
               std::regex_search(value.get<std::string>(), std::regex(allowed.get<std::string>()));
    } else if (keyword == "minItems") {
        fits = !value.is_array() || value.size() >= allowed.get<std::size_t>();
    } else if (keyword == "maxItems") {
        fits = !value.is_array() || value.size() <= allowed.get<std::size_t>();
    } else if (keyword == "additionalProperties") {
        fits = allowed == false;  // nothing else is in use
    } else if (keyword == "anyOf") {
        fits = fitting(allowed, value) >= 1;
    } else if (keyword == "oneOf") {
        fits = fitting(allowed, value) == 1;
    }
    if (!fits) faults_.push_back(at + ": " + value.dump().substr(0, 80) + " against " + keyword);
}

}  // namespace viaface
