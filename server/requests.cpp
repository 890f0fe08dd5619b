#include "server/requests.hpp"

#include <charconv>

#include "base/error.hpp"
#include "server/json_fields.hpp"

namespace viaface {
namespace {

int side_of(std::string_view digits, std::string_view whole) {
    int side = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    if (error != std::errc() || end != digits.data() + digits.size()) {
        throw InputError("size", std::string(whole), "WIDTHxHEIGHT in pixels, for example 512x512");
    }
    return side;
}

template <class Value, class Target>
void take(std::optional<Value> value, Target& target) {
    if (value) target = std::move(*value);
}

void read_speech(JsonFields& fields, VideoRequest& request) {
    SpeechRequest& speech = request.say.speech;
    take(fields.text("text"), speech.text);
    take(fields.text("phones"), speech.phones);
    if (fields.has("phones") && (fields.has("text") || speech.phones.empty()))
        throw InputError("phones", speech.phones, "one of text and phones, not empty");
    request.voice = fields.text("voice");
    take(request.voice, speech.voice);
    take(fields.number("rate"), speech.prosody.rate);
    take(fields.number("pitch"), speech.prosody.pitch);
    take(fields.text("talker"), request.talker);
}

void read_view(JsonFields& fields, View& view) {
    const auto object = fields.object("view");
    if (!object) return;
    JsonFields angles(*object, "view");
    take(angles.number("yaw"), view.yaw);
    take(angles.number("tilt"), view.tilt);
    take(angles.number("roll"), view.roll);
    take(angles.number("field_of_view"), view.field_of_view);
    if (const auto shown = angles.text("show")) view.shown = shown_of(*shown);
    take(angles.flag("orthographic"), view.orthographic);
    if (const auto scale = angles.number("px_per_mm")) view.px_per_mm = scale;
    take(angles.flag("texture"), view.texture);
    take(angles.flag("eyes_occluded"), view.eyes_occluded);
    if (const auto background = angles.text("background")) view.background = parse_background(*background);
    angles.refuse_unknown();
}

FilmFormat stream_format(const std::string& name) {
    std::string allowed;
    for (const auto& known : stream_formats()) {
        if (name == known) return film_format(name);
        allowed += (allowed.empty() ? "" : " or ") + known;
    }
    throw InputError("format", name, allowed);
}

void read_film(JsonFields& fields, VideoRequest& request) {
    if (const auto size = fields.text("size")) set_size(request.say.view, *size);
    if (const auto fps = fields.number("fps")) request.say.fps = frame_rate(*fps);
    if (const auto format = fields.text("format")) request.format = stream_format(*format);
    take(fields.whole_number("seed"), request.say.seed);
}

// Values that JSON would hold as numbers are numbers.
nlohmann::json json_of(const Query& query) {
    nlohmann::json body = nlohmann::json::object();
    for (const auto& [name, value] : query) {
        if (body.contains(name)) throw InputError(name, value, "one value, not several");
        const auto number = nlohmann::json::parse(value, nullptr, false);
        body[name] = number.is_number() && name != "talker" ? number : nlohmann::json(value);
    }
    return body;
}

}  // namespace

void settle_voice(VideoRequest& request, const Talker& talker) {
    request.say.speech.voice =
        request.voice.value_or(talker.description.value("voice", std::string(kDefaultVoice)));
}

FilmSpec film_of(const VideoRequest& request) {
    const View& view = request.say.view;
    return {view.width, view.height, request.say.fps, request.format};
}

Renderer renderer_of(std::string_view name) {
    if (name == kDefaultRenderer) return Renderer::kRaster;
    if (name == "osmesa") return Renderer::kOsmesa;
    throw InputError("renderer", std::string(name), "raster or osmesa");
}

std::vector<std::string> stream_formats() { return {kDefaultFormat, "mkv"}; }

void set_size(View& view, std::string_view text) {
    const auto cross = std::min(text.find('x'), text.size());
    view.width = side_of(text.substr(0, cross), text);
    view.height = side_of(text.substr(std::min(cross + 1, text.size())), text);
}

VideoRequest video_request_of(const nlohmann::json& body) {
    VideoRequest request;
    JsonFields fields(body, "");
    read_speech(fields, request);
    read_film(fields, request);
    read_view(fields, request.say.view);
    fields.refuse_unknown();
    check(request.say.view);
    validate(film_of(request));
    return request;
}

VideoRequest drawing_request_of(const Query& query, const std::string& talker) {
    VideoRequest request;
    request.talker = talker;
    const nlohmann::json body = json_of(query);
    JsonFields fields(body, "");
    take(fields.text("talker"), request.talker);
    read_film(fields, request);
    fields.refuse_unknown();
    validate(film_of(request));
    return request;
}

VideoRequest viapoints_request_of(const nlohmann::json& body) {
    VideoRequest request;
    JsonFields fields(body, "");
    read_speech(fields, request);
    fields.refuse_unknown();
    return request;
}

}  // namespace viaface
