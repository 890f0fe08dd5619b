// The description against the service: its routes, its limits and its answers.
#include "server/openapi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "server/problem.hpp"
#include "server/requests.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "tests/server/schema_check.hpp"
#include "tests/server/served.hpp"

namespace viaface {
namespace {

using nlohmann::json;

const json& api() {
    static const json described = json::parse(openapi().dump());  // as a client has it
    return described;
}

// What does not fit, as one text.
std::string faults(const json& schema, const json& value) {
    std::string all;
    for (const auto& fault : SchemaCheck(api()).faults(schema, value)) all += fault + "\n";
    return all;
}
json schema(const std::string& name) { return {{"$ref", "#/components/schemas/" + name}}; }

// The field that a request is refused for; "" when it is not.
std::string refused(const std::string& kind, const json& body) {
    try {
        const VideoRequest request = kind == "Video" ? video_request_of(body) : viapoints_request_of(body);
        const Script script(request.say.speech);
        return "";
    } catch (const InputError& error) {
        return error.field();
    }
}

TEST(SchemaCheck, FindsWhatDoesNotFit) {
    const json no_root;
    const SchemaCheck check(no_root);
    const json whole = {{"type", "integer"}, {"minimum", 1}, {"maximum", 3}};
    for (const json& wrong : {json(0), json(4), json(1.5), json("2"), json(nullptr)})
        EXPECT_FALSE(check.faults(whole, wrong).empty()) << wrong;
    EXPECT_TRUE(check.faults(whole, 2).empty());
    const json object = {{"type", "object"},
                         {"properties", {{"a", {{"type", "string"}, {"maxLength", 2}}}}},
                         {"required", json::array({"a"})},
                         {"additionalProperties", false}};
    EXPECT_TRUE(check.faults(object, {{"a", "\u00e9\u00e9"}}).empty());
    EXPECT_FALSE(check.faults(object, {{"a", "xyz"}}).empty());
    EXPECT_FALSE(check.faults(object, json::object()).empty());
    EXPECT_FALSE(check.faults(object, {{"a", "x"}, {"b", 1}}).empty());
    EXPECT_FALSE(check.faults({{"type", "array"}, {"items", whole}}, {1, 2, 9}).empty());
    EXPECT_FALSE(check.faults({{"minimun", 3}}, 5).empty());  // a keyword that nobody knows
}

TEST(OpenApi, DescribesEveryRouteAndNoOther) {
    const Served served;
    std::set<std::string> described;
    for (const auto& [path, methods] : api()["paths"].items()) {
        for (const auto& [method, operation] : methods.items())
            described.insert((method == "get" ? "GET " : "POST ") + path);
    }
    const auto routes = served.routes();
    EXPECT_EQ(described, std::set<std::string>(routes.begin(), routes.end()));
    EXPECT_GT(routes.size(), 6u);
}

TEST(OpenApi, EveryReferenceLeadsSomewhere) {
    const json flat = api().flatten();
    int references = 0;
    for (const auto& [at, value] : flat.items()) {
        if (!at.ends_with("/$ref")) continue;
        EXPECT_TRUE(api().contains(json::json_pointer(value.get<std::string>().substr(1)))) << at;
        ++references;
    }
    EXPECT_GT(references, 20);
}

TEST(OpenApi, ExamplesFitTheirSchemaAndAreNotRefused) {
    int examples = 0;
    for (const auto& [path, kind] :
         {std::pair("/v1/videos", "Video"), std::pair("/v1/viapoints", "Speech")}) {
        const json& body = api()["paths"][path]["post"]["requestBody"]["content"]["application/json"];
        for (const auto& [name, example] : body["examples"].items()) {
            EXPECT_EQ(faults(body["schema"], example["value"]), "") << name;
            EXPECT_EQ(refused(kind, example["value"]), "") << name;
            ++examples;
        }
    }
    EXPECT_GE(examples, 4);
}

// ---- what a request may hold ----

// A body whose field, or field of a member, holds the value.
json with(const std::string& field, const json& value) {
    json body = json::object();
    if (field != "text" && field != "phones") body["text"] = "Hi.";
    body[json::json_pointer("/" + field)] = value;
    return json::parse(body.dump());
}

struct Probe {
    std::string kind, field;  // "view/yaw"
    json schema;

    void allows(const json& value) const {
        EXPECT_EQ(faults(viaface::schema(kind), with(field, value)), "") << field;
        EXPECT_EQ(refused(kind, with(field, value)), "") << field << " " << value;
    }
    // Both the schema and the service; the latter names the field.
    void refuses(const json& value) const {
        EXPECT_NE(faults(viaface::schema(kind), with(field, value)), "") << field << " " << value;
        const std::string named = refused(kind, with(field, value)), last = field.substr(field.find('/') + 1);
        EXPECT_TRUE(named.ends_with(last) && !last.empty()) << field << " " << value << " " << named;
    }
};

std::vector<Probe> probes_of(const std::string& kind, const json& properties,
                             const std::string& before = "") {
    std::vector<Probe> found;
    for (const auto& [name, schema] : properties.items()) {
        found.push_back({kind, before + name, schema});
        if (!schema.contains("properties")) continue;
        const auto deeper = probes_of(kind, schema["properties"], before + name + "/");
        found.insert(found.end(), deeper.begin(), deeper.end());
    }
    return found;
}

std::vector<Probe> all_probes() {
    std::vector<Probe> all;
    for (const std::string kind : {"Video", "Speech"}) {
        const auto of_kind = probes_of(kind, api()["components"]["schemas"][kind]["properties"]);
        all.insert(all.end(), of_kind.begin(), of_kind.end());
    }
    return all;
}

// "a b c ..." of so many bytes.
std::string letters(std::size_t bytes) {
    std::string text;
    while (text.size() < bytes) text += text.size() % 2 == 0 ? 'a' : ' ';
    text.back() = '.';
    return text;
}

TEST(OpenApi, NumbersAreAllowedUpToTheirLimits) {
    int limits = 0;
    for (const Probe& probe : all_probes()) {
        for (const char* limit : {"minimum", "maximum"}) {
            if (!probe.schema.contains(limit)) continue;
            ++limits;
            const json at = probe.schema[limit];
            probe.allows(at);
            const double beyond = at.get<double>() * (at.get<double>() < 0 ? 1.01
                                                      : limit[1] == 'i'    ? 0.99
                                                                           : 1.01);
            probe.refuses(at == 0 ? json(-1) : json(beyond));
        }
        if (probe.schema["type"] == "number") {
            probe.refuses("1");
            probe.refuses(true);
        }
    }
    EXPECT_EQ(limits, 2 * (2 + 2 + 7));  // of rate and pitch, twice; of fps, three angles, field, scale, seed
}

TEST(OpenApi, TextsAreAllowedUpToTheirLimits) {
    for (const Probe& probe : all_probes()) {
        if (probe.schema["type"] != "string") continue;
        probe.refuses(3);
        probe.refuses(nullptr);
        if (probe.schema.contains("enum")) {
            for (const auto& name : probe.schema["enum"]) probe.allows(name);
            probe.refuses("nobody");
        }
        if (probe.schema.contains("default")) probe.allows(probe.schema["default"]);
        if (probe.schema.contains("pattern")) probe.refuses("big");
        if (!probe.schema.contains("maxLength")) continue;
        probe.refuses("");
        probe.refuses(letters(probe.schema["maxLength"].get<std::size_t>() + 1));
        if (probe.field == "text") probe.allows(letters(probe.schema["maxLength"]));
    }
}

TEST(OpenApi, NamesTheFieldsThatTheServiceKnowsAndNoOther) {
    for (const std::string kind : {"Video", "Speech"}) {
        const json& properties = api()["components"]["schemas"][kind]["properties"];
        std::string known = "only the fields";
        try {
            const json body = {{"text", "Hi."}, {"colour", "red"}};
            kind == "Video" ? video_request_of(body) : viapoints_request_of(body);
            FAIL();
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), "colour");
            const std::size_t fields =
                1 + static_cast<std::size_t>(std::count(error.allowed().begin(), error.allowed().end(), ','));
            EXPECT_EQ(fields, properties.size()) << error.allowed();
            for (const auto& [name, schema] : properties.items())
                EXPECT_NE(error.allowed().find(name), std::string::npos) << name;
        }
    }
    EXPECT_EQ(refused("Video", {{"text", "Hi."}, {"view", {{"zoom", 1}}}}), "view.zoom");
    const json both = {{"text", "Hi."}, {"phones", "aa1"}};
    EXPECT_EQ(refused("Speech", both), "phones");
    EXPECT_NE(faults(schema("Speech"), both), "");
    EXPECT_EQ(refused("Speech", json::object()), "text");
    EXPECT_NE(faults(schema("Speech"), json::object()), "");
}

TEST(OpenApi, DescribesTheQueryBesideAStream) {
    int described = 0;
    for (const json& parameter : api()["paths"]["/v1/videos"]["post"]["parameters"]) {
        const json& schema = parameter["schema"];
        const std::string name = parameter["name"];
        const json standard = schema.at("default");
        const std::string text = standard.is_string() ? standard.get<std::string>() : standard.dump();
        EXPECT_NO_THROW(drawing_request_of({{name, text}}, "momo")) << name;
        EXPECT_THROW(drawing_request_of({{name, text}, {name, text}}, "momo"), InputError) << name;
        ++described;
    }
    EXPECT_EQ(described, 5);
    EXPECT_EQ(drawing_request_of({}, "somebody").talker, "somebody");
    EXPECT_THROW(drawing_request_of({{"text", "Hi."}}, "momo"), InputError);
}

// ---- what is answered ----

// The answer's own type and status are described, and its body fits.
void expect_described(const std::string& method, const std::string& path, const httplib::Response& answer) {
    const json& responses = api()["paths"][path][method]["responses"];
    const std::string status = std::to_string(answer.status), type = answer.get_header_value("Content-Type");
    ASSERT_TRUE(responses.contains(status)) << path << " " << status;
    ASSERT_TRUE(responses[status]["content"].contains(type)) << path << " " << status << " " << type;
    const json& described = responses[status]["content"][type];
    if (type.find("json") == std::string::npos) return;
    EXPECT_EQ(faults(described["schema"], json::parse(answer.body)), "") << path << " " << status;
}

TEST(OpenApi, TheAnswersOfTheServiceFit) {
    const Served served;
    for (const auto& [path, methods] : api()["paths"].items()) {
        if (methods.contains("get")) expect_described("get", path, *served.client().Get(path));
    }
    for (const json& said : {json{{"text", "My mother, at last, bought a 3rd boat."}},
                             json{{"phones", "ax b:90 aa1:220"}, {"voice", "kal16"}}})
        expect_described("post", "/v1/viapoints", *post(served.client(), "/v1/viapoints", said));
    for (const char* format : {"mp4", "mkv"}) {
        const json small = {{"phones", "aa1"}, {"size", "32x32"}, {"fps", 15}, {"format", format}};
        expect_described("post", "/v1/videos", *post(served.client(), "/v1/videos", small));
    }
}

TEST(OpenApi, TheProblemsOfTheServiceFit) {
    const Served served;
    auto client = served.client();
    for (const char* path : {"/v1/videos", "/v1/viapoints"}) {
        const std::pair<int, httplib::Result> answers[] = {
            {400, client.Post(path, "{", "application/json")},
            {413, client.Post(path, std::string(200000, ' '), "application/json")},
            {415, client.Post(path, "text=hi", "text/plain")},
            {422, client.Post(path, R"({"text": 3})", "application/json")},
        };
        for (const auto& [status, answer] : answers) {
            EXPECT_EQ(answer->status, status);
            expect_described("post", path, *answer);
        }
    }
    EXPECT_EQ(faults(schema("Problem"), problem_of(std::runtime_error("secret")).body), "");
    EXPECT_EQ(json(problem_of(std::runtime_error("secret")).body).dump().find("secret"), std::string::npos);
}

}  // namespace
}  // namespace viaface
