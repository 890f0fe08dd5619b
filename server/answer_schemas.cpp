#include "server/answer_schemas.hpp"

#include "synth/speech/flite_voice.hpp"
#include "viapoints/layout.hpp"

namespace viaface {
namespace {

using nlohmann::json;

json text(const char* description = nullptr) {
    json schema = {{"type", "string"}};
    if (description != nullptr) schema["description"] = description;
    return schema;
}

json number(const char* description) { return {{"type", "number"}, {"description", description}}; }
json from_zero(json schema) {
    schema["minimum"] = 0;
    return schema;
}
json seconds() { return from_zero(number("s, from the first sample")); }
json count(const char* description) { return from_zero({{"type", "integer"}, {"description", description}}); }
json share() { return {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}; }
json list(json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
json list(json items, int length) {
    return {{"type", "array"}, {"items", std::move(items)}, {"minItems", length}, {"maxItems", length}};
}
json reference(const char* name) { return {{"$ref", std::string("#/components/schemas/") + name}}; }

// All members are there, and no others.
json closed(json members) {
    json required = json::array();
    for (const auto& [name, schema] : members.items()) required.push_back(name);
    return {{"type", "object"},
            {"properties", std::move(members)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
}

json words() { return list(closed({{"text", text()}, {"begin_s", seconds()}, {"end_s", seconds()}})); }

json phones() {
    return list(closed({{"phone", text("ARPAbet, lower case; pau is a pause")},
                        {"ipa", text("the same in IPA")},
                        {"stress", {{"type", "integer"}, {"minimum", 0}, {"maximum", 2}}},
                        {"begin_s", seconds()},
                        {"end_s", seconds()},
                        {"unit",
                         {{"type", "string"},
                          {"enum", {"exact", "class", "half"}},
                          {"description",
                           "how near the codex's unit is: the same triphone, one that looks "
                           "alike, or two halves"}}}}));
}

json unit_shares() { return closed({{"exact", share()}, {"class", share()}, {"half", share()}}); }

json via_points() {
    return list(
        closed({{"time_s", number("s, from the first sample")},
                {"points_mm", list(number("mm: x, y, z of each point of the layout"), kCoordinates)}}));
}

json via_points_answer() {
    return closed(
        {{"talker", text()},
         {"voice", text()},
         {"units", text("of times and points")},
         {"motion", text("where the talker's motion comes from")},
         {"sample_rate", count("Hz, of the sound that belongs to it")},
         {"duration_s", seconds()},
         {"words", words()},
         {"phones", phones()},
         {"layout", list(text("a point's name"), kPoints)},
         {"via_points", via_points()},
         {"lip_opening", closed({{"rate_hz", count("values a second")},
                                 {"mm", list(number("between the inner lips' middles, as commanded: below 0 "
                                                    "where they press"))}})},
         {"unit_shares", unit_shares()}});
}

json report() {
    return closed({{"talker", text()},
                   {"voice", text()},
                   {"sample_rate", count("Hz")},
                   {"samples", count("of the sound")},
                   {"duration_s", seconds()},
                   {"frames", count("of the film")},
                   {"fps", number("frames per second")},
                   {"size", text("WIDTHxHEIGHT, pixels")},
                   {"words", words()},
                   {"phones", phones()},
                   {"unit_shares", unit_shares()},
                   {"drawn_minus_commanded_mm",
                    closed({{"rms", from_zero(number("mm"))}, {"max", from_zero(number("mm"))}})},
                   {"hashes", closed({{"sound", text("FNV-1a of the samples")},
                                      {"motion", text("FNV-1a of the commanded points")}})}});
}

json health() {
    return closed({{"status", {{"type", "string"}, {"enum", {"ok"}}}},
                   {"running", count("jobs")},
                   {"waiting", count("jobs")}});
}

json voices() {
    return closed({{"voices", list(closed({{"name", {{"type", "string"}, {"enum", FliteVoice::names()}}},
                                           {"language", text("BCP 47")}}))},
                   {"default", text("the voice of talkers that have none of their own")}});
}

// A talker's own description may say more.
json talker() {
    return {{"type", "object"},
            {"properties",
             {{"name", text("for requests")},
              {"summary", text("who it is")},
              {"voice", text("who is heard in requests that name no voice")},
              {"language", text("BCP 47")},
              {"licence", text()},
              {"notice", text()},
              {"provenance",
               {{"type", "object"},
                {"description", "where its parts come from"},
                {"properties", {{"motion", text("measured, or performed by a model")}}},
                {"required", {"motion"}}}}}},
            {"required", {"name", "summary", "language", "licence", "provenance"}}};
}

json talkers() {
    return closed(
        {{"talkers", list(reference("Talker"))}, {"default", text("the talker of requests that name none")}});
}

json problem_members() {
    return {{"type", text("about:blank")},
            {"title", text()},
            {"status", {{"type", "integer"}, {"minimum", 400}, {"maximum", 599}}},
            {"detail", text()}};
}

json field_problem() {
    json members = problem_members();
    members["field"] = text("the field, such as view.yaw");
    members["value"] = text("what it held, shortened");
    members["allowed"] = text("what it may hold");
    return closed(members);
}

}  // namespace

json answer_schemas() {
    return {{"Health", health()},
            {"Voices", voices()},
            {"Talker", talker()},
            {"Talkers", talkers()},
            {"ViaPoints", via_points_answer()},
            {"Report", report()},
            {"Problem", closed(problem_members())},
            {"FieldProblem", field_problem()}};
}

}  // namespace viaface
