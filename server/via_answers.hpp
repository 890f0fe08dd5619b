// Streams of via points to and from clients of the service.
#pragma once

#include "server/requests.hpp"
#include "synth/motion/motion_input.hpp"
#include "synth/say/recital.hpp"

namespace viaface {

inline constexpr double kAnsweredBound = 1;  // mm, of a stream that answers

// What the face would pass, with its phones, by the talker's stream model or, where it has none, with a basis
// of its own. What `check_wanted`, called now and then, throws ends it.
Bytes spoken_stream(const Script& script, const Talker& talker, const StreamModel* model,
                    const std::function<void()>& check_wanted);

// Who draws a stream when nobody is asked for: the talker that it names, else the default one.
// InputError("stream", ...) for bytes that are none.
std::string talker_of(const Bytes& stream);

// A stream as motion to be drawn: InputError("stream", ...) for bytes that are none or name a talker whose
// model is not among `models`.
MotionInput streamed_motion(const Bytes& stream, const Talker& talker, std::vector<StreamModel> models);

}  // namespace viaface
