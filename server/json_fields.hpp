// Strict reading of a JSON object: wrong types and unknown names are InputErrors that name the field and what
// is allowed.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace viaface {

class JsonFields {
  public:
    // `path` names the object in errors: "" for the body, "view" for a field of it.
    JsonFields(const nlohmann::json& object, std::string path);

    std::optional<std::string> text(const std::string& name);
    std::optional<double> number(const std::string& name);
    std::optional<std::uint64_t> whole_number(const std::string& name);
    std::optional<nlohmann::json> object(const std::string& name);

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
