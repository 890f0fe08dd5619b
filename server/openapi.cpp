#include "server/openapi.hpp"

#include "server/answer_schemas.hpp"
#include "server/http_body.hpp"
#include "server/problem.hpp"
#include "server/request_fields.hpp"
#include "server/requests.hpp"
#include "server/service.hpp"
#include "web/web_files.hpp"

namespace viaface {
namespace {

using nlohmann::json;

json content(const std::string& type, json schema) { return {{type, {{"schema", std::move(schema)}}}}; }
json reference(const std::string& name) { return {{"$ref", "#/components/schemas/" + name}}; }

json problem_response(const std::string& description, const char* schema = "Problem") {
    return {{"description", description}, {"content", content(kProblemType, reference(schema))}};
}

json failure() { return problem_response("The service failed; its log says why."); }

json full_queue() {
    json response = problem_response("The queue is full.");
    response["headers"]["Retry-After"] = {{"description", "when to try again, s"},
                                          {"schema", {{"type", "integer"}, {"minimum", 0}}}};
    return response;
}

// Exactly one of text and phones.
json request_schema(json fields) {
    return {{"type", "object"},
            {"properties", std::move(fields)},
            {"additionalProperties", false},
            {"oneOf", {{{"required", {"text"}}}, {{"required", {"phones"}}}}}};
}

json posted(const std::string& summary, const char* request, json examples, json answer) {
    json body = {{"required", true},
                 {"description", "at most " + std::to_string(kLargestBody) + " bytes, after decompression"},
                 {"content", content(kJsonType, reference(request))}};
    body["content"][kJsonType]["examples"] = std::move(examples);
    json responses = {{"200", std::move(answer)}};
    responses["400"] = problem_response("The body is not JSON.");
    responses["413"] =
        problem_response("The body holds more than " + std::to_string(kLargestBody) + " bytes.");
    responses["415"] = problem_response("The body is not application/json.");
    responses["422"] = problem_response("A field's value is not allowed.", "FieldProblem");
    responses["500"] = failure();
    responses["503"] = full_queue();
    return {{"post", {{"summary", summary}, {"requestBody", body}, {"responses", responses}}}};
}

json got(const std::string& summary, const std::string& type, json schema) {
    json responses;
    responses["200"] = {{"description", summary}, {"content", content(type, std::move(schema))}};
    responses["500"] = failure();
    return {{"get", {{"summary", summary}, {"responses", responses}}}};
}

json example(const char* summary, json value) { return {{"summary", summary}, {"value", std::move(value)}}; }

// Of the query, beside a stream of via points.
json drawing_parameters() {
    const json fields = video_fields();
    json parameters = json::array();
    for (const char* name : kDrawingFields)
        parameters.push_back({{"name", name},
                              {"in", "query"},
                              {"description", "beside a stream of via points alone; a JSON body has its own"},
                              {"schema", fields.at(name)}});
    return parameters;
}

json videos() {
    json answer = {
        {"description", "The film, sent while it is made. One that fails is cut without its closing chunk."}};
    for (const auto& format : stream_formats()) {
        answer["content"][stream_type(film_format(format))] = json::object();
    }
    json examples;
    examples["sentence"] = example("a sentence", {{"text", "My mother bought a very big boat."}});
    examples["side"] =
        example("another voice, from a side", {{"text", "Here I am."},
                                               {"voice", "slt"},
                                               {"size", "640x480"},
                                               {"fps", 25},
                                               {"view", {{"yaw", 30}, {"background", "#204060"}}}});
    examples["phones"] =
        example("nonsense, exactly timed, lossless", {{"phones", "ax b:90 aa1:220"}, {"format", "mkv"}});
    json route = posted("A talking-face video, streamed as it is made", "Video", examples, answer);
    json& body = route["post"]["requestBody"];
    body["content"][kViaType] = json::object();
    body["description"] =
        body["description"].get<std::string>() +
        "; a stream of via points is drawn as it moves, without sound, as the query asks, by the talker "
        "that it names when no other is asked for";
    route["post"]["parameters"] = drawing_parameters();
    route["post"]["responses"]["415"] =
        problem_response("The body is neither application/json nor " + std::string(kViaType) + ".");
    return route;
}

json viapoints() {
    json examples;
    examples["sentence"] = example("a sentence", {{"text", "My mother bought a very big boat."}});
    json answer = {{"description",
                    "mm and s, head frame: x to the talker's left, y up, z forward; to those who "
                    "accept " +
                        std::string(kViaType) + " as a stream, within 1 mm, with phones"},
                   {"content", content(kJsonType, reference("ViaPoints"))}};
    answer["content"][kViaType] = json::object();
    json route =
        posted("The via points that the face would pass, with words and phones", "Speech", examples, answer);
    route["post"]["responses"]["406"] = problem_response("The client accepts neither type of answer.");
    return route;
}

json self() {
    return {{"type", "object"},
            {"properties", {{"openapi", {{"const", "3.1.0"}}}}},
            {"required", {"openapi", "info", "paths", "components"}}};
}

json paths() {
    json paths;
    paths["/v1/videos"] = videos();
    paths["/v1/viapoints"] = viapoints();
    paths["/v1/talkers"] = got("The talkers", kJsonType, reference("Talkers"));
    paths["/v1/voices"] = got("The voices", kJsonType, reference("Voices"));
    paths["/healthz"] =
        got("That the service is well, and how many jobs run and wait", kJsonType, reference("Health"));
    paths["/openapi.json"] = got("This description", kJsonType, self());
    const json page = {{"type", "string"}};
    paths["/"] = got("The page", content_type_of("index.html"), page);
    for (const WebFile& file : web_files()) {
        paths["/" + std::string(file.name)] = got("A file of the page", content_type_of(file.name), page);
    }
    return paths;
}

}  // namespace

json openapi() {
    json schemas = answer_schemas();
    schemas["Video"] = request_schema(video_fields());
    schemas["Speech"] = request_schema(speech_fields());
    json info = {{"title", "viaface"},
                 {"version", "1"},
                 {"description",
                  "Text in, a talking-face video out. Work is bounded: so many jobs run and wait, "
                  "one more is answered 503. Errors are problem details [RFC 9457]."}};
    return {{"openapi", "3.1.0"}, {"info", info}, {"paths", paths()}, {"components", {{"schemas", schemas}}}};
}

}  // namespace viaface
