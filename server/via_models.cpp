#include "server/via_models.hpp"

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "synth/talker/stream_models.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "viapoints/via_stream_head.hpp"

namespace viaface {
namespace {

std::filesystem::path folder_of(const std::string& talker) {
    if (talker.find('/') != std::string::npos) return talker;
    TalkerShelf(talkers_folder()).description(talker);  // refuses a name that is not on the shelf
    return talkers_folder() / talker;
}

std::vector<StreamModel> stream_models_of(const std::string& talker) {
    if (talker.empty()) return all_stream_models(talkers_folder());
    return {load_stream_model(folder_of(talker))};
}

}  // namespace

std::unique_ptr<const StreamModel> stream_model_of(const std::string& talker, const std::string& file) {
    if (!talker.empty() && !file.empty()) throw InputError("model", file, "a file, or --talker, not both");
    if (!file.empty()) return std::make_unique<const StreamModel>(read_stream_model_file(file));
    if (talker.empty()) return nullptr;
    return std::make_unique<const StreamModel>(load_stream_model(folder_of(talker)));
}

std::vector<StreamModel> drawn_stream_models(const std::string& talker) {
    std::vector<StreamModel> models;
    if (auto own = find_stream_model(folder_of(talker))) models.push_back(std::move(*own));
    return models;
}

StreamModelsAtHand::StreamModelsAtHand(const std::string& talker, const std::string& file)
    : models_(stream_models_of(talker)) {
    if (!file.empty()) models_.push_back(read_stream_model_file(file));
    for (const StreamModel& model : models_) all_.push_back(&model);
}

Bytes read_stream_file(const std::string& file, const std::vector<const StreamModel*>& models) {
    Bytes bytes = read_bytes(file, "stream");
    try {
        read_stream_head(bytes, models);
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw InputError("stream", file, "a stream of via points with a whole head: " + describe(error));
    }
    return bytes;
}

}  // namespace viaface
