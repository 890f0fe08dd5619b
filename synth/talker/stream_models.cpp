#include "synth/talker/stream_models.hpp"

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/talker/talker_shelf.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 4u << 20;

}  // namespace

StreamModel read_stream_model_file(const fs::path& file) {
    const Bytes bytes = read_bytes(file, "talker", kLargestFile);
    try {
        return read_stream_model(bytes);
    } catch (const std::runtime_error& error) {
        throw InputError("talker", file.string(), "a stream model: " + describe(error));
    }
}

std::optional<StreamModel> find_stream_model(const fs::path& talker_folder) {
    const fs::path file = talker_folder / kStreamModelFile;
    if (!fs::exists(file)) return std::nullopt;
    return read_stream_model_file(file);
}

StreamModel load_stream_model(const fs::path& talker_folder) {
    if (auto model = find_stream_model(talker_folder)) return std::move(*model);
    throw InputError("talker", talker_folder.string(),
                     std::string("a talker with a ") + kStreamModelFile +
                         ", which `viaface_train make` and `viaface via learn` write");
}

std::vector<StreamModel> all_stream_models(const fs::path& talkers_folder) {
    std::vector<StreamModel> models;
    for (const std::string& name : TalkerShelf(talkers_folder).names()) {
        if (auto model = find_stream_model(talkers_folder / name)) models.push_back(std::move(*model));
    }
    return models;
}

}  // namespace viaface
