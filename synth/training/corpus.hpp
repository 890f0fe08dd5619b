// What the built-in talker recites beside the sentences of a text: strings of phones made by rule so that
// every ordered pair of phones occurs, pauses included.
#pragma once

#include <string>
#include <vector>

namespace viaface {

// For parse_phones(): VCV, CVC, CC, VV and phrase edges in strings of up to 24 phones. Every phone occurs
// between every pair of viseme classes, pause included, and every ordered pair of phones occurs, so that no
// triphone has to be made of halves.
std::vector<std::string> generated_strings();

}  // namespace viaface
