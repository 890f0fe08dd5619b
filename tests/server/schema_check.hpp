// The part of JSON Schema (2020-12) that the service's description uses. A keyword that is not known here is
// a fault too, so that nothing goes unchecked.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace viaface {

class SchemaCheck {
  public:
    // `root` is where "#/..." points; it outlives this.
    explicit SchemaCheck(const nlohmann::json& root) : root_(root) {}

    // Where and why `value` does not fit; empty when it does.
    std::vector<std::string> faults(const nlohmann::json& schema, const nlohmann::json& value) const;

  private:
    void check(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at) const;
    void check_object(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at) const;
    void check_array(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at) const;
    void check_keyword(const std::string& keyword, const nlohmann::json& allowed, const nlohmann::json& value,
                       const std::string& at) const;
    int fitting(const nlohmann::json& schemas, const nlohmann::json& value) const;

    const nlohmann::json& root_;
    mutable std::vector<std::string> faults_;
};

}  // namespace viaface
