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
    take(fields.text("voice"), speech.voice);
    take(fields.number("rate"), speech.prosody.rate);
    take(fields.number("pitch"), speech.prosody.pitch);
    take(fields.text("talker"), request.talker);
}

void read_view(JsonFields& fields, View& view) {
    if (const auto size = fields.text("size")) set_size(view, *size);
    const auto object = fields.object("view");
    if (!object) return;
    JsonFields angles(*object, "view");
    take(angles.number("yaw"), view.yaw);
    take(angles.number("tilt"), view.tilt);
    take(angles.number("roll"), view.roll);
    if (const auto background = angles.text("background")) view.background = parse_background(*background);
    angles.refuse_unknown();
}

}  // namespace

void set_size(View& view, std::string_view text) {
    const auto cross = std::min(text.find('x'), text.size());
    view.width = side_of(text.substr(0, cross), text);
    view.height = side_of(text.substr(std::min(cross + 1, text.size())), text);
}

VideoRequest video_request_of(const nlohmann::json& body) {
    VideoRequest request;
    JsonFields fields(body, "");
    read_speech(fields, request);
    read_view(fields, request.say.view);
    if (const auto fps = fields.number("fps")) request.say.fps = frame_rate(*fps);
    const auto format = fields.text("format");
    if (format && *format != "mp4") throw InputError("format", *format, "mp4: only it can be streamed");
    take(fields.whole_number("seed"), request.say.seed);
    fields.refuse_unknown();
    check(request.say.view);
    validate(FilmSpec{request.say.view.width, request.say.view.height, request.say.fps});
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
