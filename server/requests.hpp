// What a request of the service or of the command line asks for.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "synth/say/say.hpp"

namespace viaface {

inline constexpr const char* kDefaultTalker = "momo";

struct VideoRequest {
    SayRequest say;
    std::string talker = kDefaultTalker;
};

// "640x480" into the view's size; InputError("size", ...).
void set_size(View& view, std::string_view text);

// The body of POST /v1/videos and, less what concerns pictures, of POST /v1/viapoints. InputError naming the
// field.
VideoRequest video_request_of(const nlohmann::json& body);
VideoRequest viapoints_request_of(const nlohmann::json& body);

}  // namespace viaface
