// What a request of the service or of the command line asks for.
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "synth/say/say.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {

inline constexpr const char* kDefaultTalker = "momo";
inline constexpr const char* kDefaultFormat = "mp4";
inline constexpr const char* kDefaultRenderer = "raster";
inline constexpr const char* kRendererHelp =
    "raster, our own, or osmesa, Mesa's: the reference, some ten times slower";

struct VideoRequest {
    SayRequest say;
    FilmFormat format = FilmFormat::kMp4;
    std::string talker = kDefaultTalker;
    std::optional<std::string> voice;  // none: the talker's own
};

// The voice asked for, or the talker's own, is who is heard.
void settle_voice(VideoRequest& request, const Talker& talker);

FilmSpec film_of(const VideoRequest& request);

// "640x480" into the view's size; InputError("size", ...).
void set_size(View& view, std::string_view text);

Renderer renderer_of(std::string_view name);  // "raster" or "osmesa"; else InputError("renderer", ...)

std::vector<std::string> stream_formats();  // "mp4", ...

// The body of POST /v1/videos and, less what concerns pictures, of POST /v1/viapoints. InputError naming the
// field.
VideoRequest video_request_of(const nlohmann::json& body);
VideoRequest viapoints_request_of(const nlohmann::json& body);

// The query of POST /v1/videos with a stream for a body: fields of a video that concern its drawing, each at
// most once, as in JSON. `talker` draws when none is named.
using Query = std::multimap<std::string, std::string>;
VideoRequest drawing_request_of(const Query& query, const std::string& talker);
inline constexpr std::array kDrawingFields = {"talker", "size", "fps", "format", "seed"};

}  // namespace viaface
