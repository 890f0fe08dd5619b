// Text split into sentences that a voice can speak one by one, with every limit that keeps a request bounded.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viaface {

inline constexpr std::size_t kLongestText = 20000;    // bytes of UTF-8; some 20 minutes of speech
inline constexpr std::size_t kLongestToken = 100;     // characters between two spaces
inline constexpr std::size_t kLongestSentence = 300;  // letters; a digit or sign counts as 6, a capital as 2

// Sentences end at . ! ? and at empty lines, but not at the period of "Mr.", "e.g.", "J." or "3.14". A
// sentence that is too long is cut at a semicolon, colon or comma, or else at a space. Each result holds a
// letter or digit. InputError("text", value, allowed) for what cannot be spoken: empty text, only punctuation
// or emoji, invalid UTF-8, control characters, letters of other scripts, markup such as <prosody>, an endless
// word, or too much of it.
std::vector<std::string> sentences(std::string_view text);

}  // namespace viaface
