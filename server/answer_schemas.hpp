// What the service answers, as JSON Schema (2020-12) by name: Health, Voices, Talkers, Talker, ViaPoints,
// Problem, FieldProblem; and Report, which `viaface say --json` writes.
#pragma once

#include <nlohmann/json.hpp>

namespace viaface {

nlohmann::json answer_schemas();

}  // namespace viaface
