// Text as people type it, made into the ASCII that Flite reads.
#pragma once

#include <string>
#include <string_view>

namespace viaface {

// Accents fold to their letters, typographic quotes and dashes to plain ones, signs with a name to words ("
// degrees "); emoji, dingbats and invisible characters vanish. Line ends are '\n', a paragraph's end is
// "\n\n". InputError("text", ...) for invalid UTF-8, NUL and other control characters, and letters of other
// scripts.
std::string plain_text(std::string_view text);

}  // namespace viaface
