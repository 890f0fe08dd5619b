#include "server/via_models.hpp"

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "synth/talker/stream_models.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "viapoints/via_stream_head.hpp"

namespace viaface {

std::unique_ptr<const StreamModel> stream_model_of(const std::string& talker, const std::string& file) {
    if (!talker.empty() && !file.empty()) throw InputError("model", file, "a file, or --talker, not both");
    if (!file.empty()) return std::make_unique<const StreamModel>(read_stream_model_file(file));
    if (talker.empty()) return nullptr;
    TalkerShelf(talkers_folder()).description(talker);  // refuses a name that is not on the shelf
    return std::make_unique<const StreamModel>(load_stream_model(talkers_folder() / talker));
}

StreamModelsAtHand::StreamModelsAtHand(const std::string& file)
    : models_(all_stream_models(talkers_folder())) {
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
