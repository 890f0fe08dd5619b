// The talkers at hand: folders with a talker.json, each read once and then shared as const.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "synth/talker/talker.hpp"

namespace viaface {

// Thread-safe.
class TalkerShelf {
  public:
    explicit TalkerShelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::vector<std::string> names() const;                     // sorted
    nlohmann::json description(const std::string& name) const;  // its talker.json

    // InputError("talker", name, ...) for a name that is not on the shelf.
    std::filesystem::path path_of(const std::string& name) const;
    std::shared_ptr<const Talker> load(const std::string& name);

  private:
    std::filesystem::path folder_;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const Talker>> loaded_;
};

}  // namespace viaface
