// Texts to be spoken one sentence at a time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viaface {

// One sentence per line; lines that begin with # are comments. InputError("corpus", ...) when there is none.
std::vector<std::string> read_sentences(const std::filesystem::path& file);

}  // namespace viaface
