// What the built-in talker recites: the sentences of a text, and strings of phones made by rule so that every
// ordered pair of phones occurs, pauses included.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viaface {

// One sentence per line; lines that begin with # are comments. InputError("corpus", ...) when there is none.
std::vector<std::string> read_sentences(const std::filesystem::path& file);

// For parse_phones(): VCV, CVC, CC, VV and phrase edges in strings of up to 24 phones. Every phone occurs
// between every pair of viseme classes, pause included, and every ordered pair of phones occurs, so that no
// triphone has to be made of halves.
std::vector<std::string> generated_strings();

}  // namespace viaface
