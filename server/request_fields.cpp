#include "server/request_fields.hpp"

#include <limits>
#include <sstream>

#include "server/requests.hpp"
#include "synth/speech/text.hpp"

namespace viaface {
namespace {

using nlohmann::json;

template <class... Parts>
std::string words(const Parts&... parts) {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
}

json text(const std::string& description, std::size_t longest) {
    return {{"type", "string"}, {"description", description}, {"minLength", 1}, {"maxLength", longest}};
}

json one_of(const std::string& description, const std::vector<std::string>& names) {
    std::string allowed;
    for (const auto& name : names) allowed += (allowed.empty() ? ": " : ", ") + name;
    return {{"type", "string"}, {"description", description + allowed}, {"enum", names}};
}

json one_of(const std::string& description, const std::vector<std::string>& names,
            std::string_view standard) {
    json field = one_of(description, names);
    field["default"] = standard;
    return field;
}

json number(const std::string& description, double least, double most, double standard) {
    return {{"type", "number"},
            {"description", description},
            {"minimum", least},
            {"maximum", most},
            {"default", standard}};
}

json frame_rates() {
    json field = number(words("frames per second: a whole number, ", kLowestFrameRate, " to ",
                              kHighestFrameRate, ", or 23.976, 29.97, 59.94, 119.88"),
                        kLowestFrameRate, kHighestFrameRate, FrameRate().numerator);
    field["anyOf"] = {{{"type", "integer"}}, {{"enum", {23.976, 29.97, 59.94, 119.88}}}};
    return field;
}

json sizes() {
    const View standard;
    return {{"type", "string"},
            {"description", words("WIDTHxHEIGHT in pixels, ", kSmallestFilmSide, " to ", kLargestFilmSide,
                                  " each; even for mp4")},
            {"pattern", "^[0-9]+x[0-9]+$"},
            {"default", words(standard.width, "x", standard.height)}};
}

json flag(const std::string& description, bool standard) {
    return {{"type", "boolean"}, {"description", description}, {"default", standard}};
}

json angle(const char* what, double standard) {
    return number(words(what, ", ", -View::kWidestTurn, " to ", View::kWidestTurn), -View::kWidestTurn,
                  View::kWidestTurn, standard);
}

}  // namespace

json speech_fields() {
    const SpeechRequest standard;
    const std::string factor = words(kLeast, " to ", kMost, " times the voice's own");
    json fields;
    fields["text"] = text(words("what to say, English, at most ", kLongestText,
                                " bytes of UTF-8 in words of at most ", kLongestToken, " characters"),
                          kLongestText);
    fields["phones"] = text(
        words(
            "instead of text: ARPAbet phones, vowels with a stress digit, each with an optional duration of ",
            kShortestPhone, " to ", kLongestPhone, " ms, such as \"ax b:90 aa1:220\"; at most ", kMostPhones,
            " phones, ", kLongestPhones / 1000, " s in all"),
        kLongestText);
    fields["phones"]["examples"] = {"ax b:90 aa1:220"};
    fields["voice"] = one_of("who is heard, when absent the talker's own voice", FliteVoice::names());
    fields["rate"] = number("speaking rate, " + factor, kLeast, kMost, standard.prosody.rate);
    fields["pitch"] = number("pitch, " + factor, kLeast, kMost, standard.prosody.pitch);
    fields["talker"] = {{"type", "string"}, {"description", "a talker's name"}, {"default", kDefaultTalker}};
    return fields;
}

json view_fields() {
    const View standard;
    json fields;
    fields["yaw"] = angle("degrees towards the talker's left", standard.yaw);
    fields["tilt"] = angle("degrees, the chin lifted", standard.tilt);
    fields["roll"] = angle("degrees counter-clockwise in the picture", standard.roll);
    fields["show"] =
        one_of("what is seen (points: the markers alone; wireframe: the mesh as lines)",
               std::vector<std::string>(kShownNames.begin(), kShownNames.end()), kShownNames.front());
    fields["field_of_view"] =
        number(words("degrees over the picture's shorter side when the whole head is shown, ",
                     View::kNarrowestField, " to ", View::kWidestField),
               View::kNarrowestField, View::kWidestField, standard.field_of_view);
    fields["orthographic"] =
        flag("seen along parallel lines; the field of view is without effect", standard.orthographic);
    fields["px_per_mm"] = {
        {"type", "number"},
        {"description", words("pixels per mm, ", View::kSmallestScale, " to ", View::kLargestScale,
                              ": everywhere if orthographic, else at the depth of the picture's middle; "
                              "absent: what is shown fills the picture")},
        {"minimum", View::kSmallestScale},
        {"maximum", View::kLargestScale}};
    fields["texture"] = flag("false: each material in one colour", standard.texture);
    fields["eyes_occluded"] = flag("a black bar over the eyes", standard.eyes_occluded);
    fields["background"] = {
        {"type", "string"},
        {"description",
         "#rrggbb, black, white, grey, green or blue; when absent a soft grey, black behind "
         "points, white behind a wireframe"},
        {"pattern", "^(#[0-9a-fA-F]{6}|black|white|grey|green|blue)$"}};
    return fields;
}

json video_fields() {
    json fields = speech_fields();
    fields["format"] = one_of("of the stream (fragmented MP4 of H.264 and AAC, or lossless Matroska)",
                              stream_formats(), kDefaultFormat);
    fields["size"] = sizes();
    fields["fps"] = frame_rates();
    fields["view"] = {{"type", "object"},
                      {"description", "from where the face is seen"},
                      {"properties", view_fields()},
                      {"additionalProperties", false}};
    fields["seed"] = {{"type", "integer"},
                      {"description", "of the blinks, a whole number from 0"},
                      {"minimum", 0},
                      {"maximum", std::numeric_limits<std::uint64_t>::max()},
                      {"default", SayRequest().seed}};
    return fields;
}

std::string description_of(const std::string& field) {
    const json video = video_fields();
    return (video.contains(field) ? video : video["view"]["properties"]).at(field).at("description");
}

}  // namespace viaface
