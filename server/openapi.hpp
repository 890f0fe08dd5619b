// The service's description, OpenAPI 3.1, with the limits that the code holds.
#pragma once

#include <nlohmann/json.hpp>

namespace viaface {

nlohmann::json openapi();

}  // namespace viaface
