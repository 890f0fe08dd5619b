#include "server/openapi.hpp"

#include "server/problem.hpp"
#include "server/requests.hpp"
#include "server/service.hpp"
#include "synth/speech/text.hpp"

namespace viaface {
namespace {

using nlohmann::json;

json number(double least, double most, double standard, const std::string& description) {
    return {{"type", "number"},
            {"minimum", least},
            {"maximum", most},
            {"default", standard},
            {"description", description}};
}

json speech_properties() {
    return {
        {"text",
         {{"type", "string"},
          {"minLength", 1},
          {"maxLength", kLongestText},
          {"description", "English, UTF-8; the limit is in bytes. Either text or phones."}}},
        {"phones",
         {{"type", "string"},
          {"examples", json::array({"ax b:90 aa1:220"})},
          {"description",
           "ARPAbet phones, vowels with a stress digit, each with an optional duration in ms (20 to "
           "2000)."}}},
        {"voice", {{"type", "string"}, {"enum", FliteVoice::names()}, {"default", kDefaultVoice}}},
        {"rate", number(kLeast, kMost, 1, "Speaking rate, times the voice's own.")},
        {"pitch", number(kLeast, kMost, 1, "Pitch, times the voice's own.")},
        {"talker",
         {{"type", "string"}, {"default", kDefaultTalker}, {"description", "A name of GET /v1/talkers."}}},
    };
}

json view_schema() {
    const auto angle = [](const char* what) {
        return number(-View::kWidestTurn, View::kWidestTurn, 0, what);
    };
    return {{"type", "object"},
            {"additionalProperties", false},
            {"properties",
             {{"yaw", angle("Degrees towards the talker's left.")},
              {"tilt", angle("Degrees, the chin lifted.")},
              {"roll", angle("Degrees, counter-clockwise in the picture.")},
              {"background",
               {{"type", "string"},
                {"description", "#rrggbb, black, white, grey, green or blue; a soft grey when absent."}}}}}};
}

json video_schema() {
    json properties = speech_properties();
    properties["fps"] = number(kLowestFrameRate, kHighestFrameRate, 30,
                               "Frames per second: a whole number, 23.976, 29.97, 59.94 or 119.88.");
    properties["size"] = {{"type", "string"},
                          {"pattern", "^[0-9]+x[0-9]+$"},
                          {"default", "512x512"},
                          {"description", "WIDTHxHEIGHT, each an even number from 16 to 4096."}};
    properties["view"] = view_schema();
    properties["format"] = {{"type", "string"}, {"enum", json::array({"mp4"})}, {"default", "mp4"}};
    properties["seed"] = {
        {"type", "integer"}, {"minimum", 0}, {"default", 1}, {"description", "Of the blinks."}};
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

json problem_response(const char* description) {
    return {{"description", description},
            {"content", {{kProblemType, {{"schema", {{"$ref", "#/components/schemas/Problem"}}}}}}}};
}

json with_problems(json responses) {
    responses["400"] = problem_response("The body is not JSON.");
    responses["413"] = problem_response("The body is over the limit of bytes.");
    responses["415"] = problem_response("The body is not application/json.");
    responses["422"] =
        problem_response("A field's value is not allowed; the members field, value and allowed say which.");
    responses["503"] = problem_response("The queue is full; Retry-After says when to try again, in s.");
    return responses;
}

json posted(const char* summary, const char* schema, json answer) {
    return {{"post",
             {{"summary", summary},
              {"requestBody",
               {{"required", true}, {"content", {{"application/json", {{"schema", {{"$ref", schema}}}}}}}}},
              {"responses", with_problems({{"200", std::move(answer)}})}}}};
}

json got(const char* summary, const char* type) {
    return {{"get",
             {{"summary", summary},
              {"responses", {{"200", {{"description", summary}, {"content", {{type, json::object()}}}}}}}}}};
}

json problem_schema() {
    const json text = {{"type", "string"}};
    return {{"type", "object"},
            {"properties",
             {{"type", text},
              {"title", text},
              {"status", {{"type", "integer"}}},
              {"detail", text},
              {"field", text},
              {"value", text},
              {"allowed", text}}}};
}

}  // namespace

json openapi() {
    json paths;
    paths["/v1/videos"] =
        posted("A talking-face video, streamed as it is made", "#/components/schemas/Video",
               {{"description",
                 "A fragmented MP4 (H.264, AAC). A stream that fails is cut without its closing chunk."},
                {"content", {{kStreamType, json::object()}}}});
    paths["/v1/viapoints"] = posted("The via points that the face would pass", "#/components/schemas/Speech",
                                    {{"description", "Words, phones and via points (mm, s, head frame)."},
                                     {"content", {{"application/json", json::object()}}}});
    paths["/v1/talkers"] = got("The talkers", "application/json");
    paths["/v1/voices"] = got("The voices", "application/json");
    paths["/healthz"] =
        got("Whether the service is well, and how many jobs run and wait", "application/json");
    paths["/openapi.json"] = got("This description", "application/json");
    return {{"openapi", "3.1.0"},
            {"info",
             {{"title", "viaface"},
              {"version", "1"},
              {"description", "Text in, a talking-face video out. The body is limited to " +
                                  std::to_string(kLargestBody) + " bytes."}}},
            {"paths", paths},
            {"components",
             {{"schemas",
               {{"Video", video_schema()},
                {"Speech",
                 {{"type", "object"}, {"additionalProperties", false}, {"properties", speech_properties()}}},
                {"Problem", problem_schema()}}}}}};
}

}  // namespace viaface
