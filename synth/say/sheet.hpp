// A talker's contact sheet: neutral, five vowels, m, f, th, w, s, profile, three-quarter and blink, each with
// its label. What is to be looked at before a talker is published.
#pragma once

#include <string>

#include "synth/talker/talker.hpp"

namespace viaface {

// The points in the middle of the first such phone of a recital of `phones`, as in "aa1:150 f:200 aa1:150";
// at the beginning of a pause.
Configuration points_in_phone(const Codex& codex, const std::string& phones, std::string_view phone);

Texture contact_sheet(const Talker& talker);  // 3 channels

}  // namespace viaface
