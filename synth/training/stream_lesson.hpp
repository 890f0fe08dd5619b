// A talker's stream model, once the talker is made: learned from its own speech and, where recordings of
// blend shapes are at hand and the talker has such shapes, from those as its points move in them. What is
// recorded is of another kind than what the codex speaks; both travel.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace viaface {

// Writes stream.bin into the folder. `data` may hold facegood/.
void teach_stream(const std::filesystem::path& talker_folder, const std::filesystem::path& data,
                  const std::vector<std::string>& sentences,
                  const std::function<void(const std::string&)>& progress);

}  // namespace viaface
