// Which files of a folder make up its recordings: those with the same stem belong together.
//   stem.csv, .c3d, .trc or .via   the motion of the points
//   stem.wav or .flac              the sound
//   stem.TextGrid, or else stem.txt   the phones with their times, or else the words
// Other files are read over.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viaface {

struct TakeFiles {
    std::string name;                                         // the stem
    std::filesystem::path motion, sound, labels, transcript;  // labels or transcript may be empty, not both
};

// By name. InputError(field, ...) naming the file for what has no partner, for two that claim the same part,
// for two motions of the same bytes, and for a folder that holds no recording.
std::vector<TakeFiles> find_takes(const std::filesystem::path& folder, const std::string& field);

}  // namespace viaface
