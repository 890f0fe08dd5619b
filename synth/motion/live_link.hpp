// A take of the app Live Link Face as CSV:
//
//   Timecode,BlendShapeCount,EyeBlinkLeft,...,TongueOut,HeadYaw,...,RightEyeRoll
//   13:13:04:31.652,61,0.12,...
//
// Time code is hours:minutes:seconds:frames, frames with a fraction and counted at a rate that the file does
// not tell: of 60, 120, 50, 48, 30, 25 and 24 per second, the one that lies above every frame number and
// makes the steps from row to row most even; 60, the app's own, where a take is too short to tell. Times
// count from the first row and may pass midnight. BlendShapeCount is the number of columns after it; a row
// with 0 was taken while no face was seen: all of it is NaN. The turns of head and eyes (rad) are kept as
// extra columns.
#pragma once

#include <string>
#include <string_view>

#include "synth/motion/blend_recording.hpp"

namespace viaface {

inline constexpr std::size_t kLiveLinkRows = 500'000;
inline constexpr std::size_t kLiveLinkColumns = 256;

// The first line is such a file's header.
bool is_live_link(std::string_view text);

// InputError names the line and the column in its field.
BlendRecording parse_live_link(std::string_view text, const std::string& field = "motion");

}  // namespace viaface
