#include "synth/talker/talker_shelf.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace viaface {

namespace fs = std::filesystem;

std::vector<std::string> TalkerShelf::names() const {
    std::vector<std::string> found;
    if (!fs::is_directory(folder_)) return found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
        if (fs::exists(entry.path() / "talker.json")) found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

fs::path TalkerShelf::path_of(const std::string& name) const {
    const auto known = names();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        std::string allowed;
        for (const auto& each : known) allowed += (allowed.empty() ? "" : ", ") + each;
        throw InputError("talker", name, allowed);
    }
    return folder_ / name;
}

nlohmann::json TalkerShelf::description(const std::string& name) const {
    return read_talker_json(path_of(name));
}

std::shared_ptr<const Talker> TalkerShelf::load(const std::string& name) {
    const std::lock_guard lock(mutex_);
    auto& talker = loaded_[name];
    if (!talker) {
        try {
            talker = std::make_shared<const Talker>(load_talker(path_of(name)));
        } catch (...) {
            loaded_.erase(name);
            throw;
        }
    }
    return talker;
}

}  // namespace viaface
