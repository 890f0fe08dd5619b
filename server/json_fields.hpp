// Strict reading of JSON from strangers: what is no JSON, or nested deeper than any request, is NotJson; in
// an object wrong types and unknown names are InputErrors that name the field and what is allowed.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace viaface {

inline constexpr int kDeepestJson = 8;  // objects and arrays in one another

class NotJson : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

nlohmann::json parse_json(std::string_view text);

class JsonFields {
  public:
    // `path` names the object in errors: "" for the body, "view" for a field of it.
    JsonFields(const nlohmann::json& object, std::string path);

    std::optional<std::string> text(const std::string& name);
    std::optional<double> number(const std::string& name);
    std::optional<bool> flag(const std::string& name);
    std::optional<std::uint64_t> whole_number(const std::string& name);
    std::optional<nlohmann::json> object(const std::string& name);

    bool has(const std::string& name) const { return object_.contains(name); }
    void refuse_unknown() const;  // names that were not asked for

  private:
    const nlohmann::json* find(const std::string& name);
    [[noreturn]] void refuse(const std::string& name, const std::string& allowed) const;
    std::string path_of(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

    const nlohmann::json& object_;
    std::string path_;
    std::vector<std::string> asked_;
};

}  // namespace viaface
