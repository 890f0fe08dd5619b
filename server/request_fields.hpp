// The fields of a request, each with its limits and its default as JSON Schema (2020-12), stated once for the
// OpenAPI description and for the command line's help. The numbers are the constants that the checks use.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace viaface {

nlohmann::json speech_fields();  // by name: of POST /v1/viapoints
nlohmann::json view_fields();    // of the member "view" of a video
nlohmann::json video_fields();   // of POST /v1/videos, those of the speech among them

// What the field is and what it may be, for help: "speaking rate, 0.5 to 2 times the voice's own".
std::string description_of(const std::string& field);  // of a video or of its view

}  // namespace viaface
