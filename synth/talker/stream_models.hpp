// The stream models of talkers: stream.bin in a talker's folder. A talker may have none.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "viapoints/stream_model.hpp"

namespace viaface {

inline constexpr const char* kStreamModelFile = "stream.bin";

// InputError("talker", ...) for a file that is none.
std::optional<StreamModel> find_stream_model(const std::filesystem::path& talker_folder);
// InputError("talker", ...) when it has none: one that names what would give it one.
StreamModel load_stream_model(const std::filesystem::path& talker_folder);
StreamModel read_stream_model_file(const std::filesystem::path& file);

// Of every talker on the shelf.
std::vector<StreamModel> all_stream_models(const std::filesystem::path& talkers_folder);

}  // namespace viaface
