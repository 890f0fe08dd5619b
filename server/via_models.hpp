// The stream models that the commands of `viaface via` may use.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viapoints/stream_model.hpp"

namespace viaface {

inline constexpr const char* kStreamTalkerHelp =
    "a built-in talker's name, or a talker's folder (with a / in it)";

// Of --talker and --model: a talker's own, or that of a file; none when both are empty. A talker is built in,
// or a folder (with a / in it).
std::unique_ptr<const StreamModel> stream_model_of(const std::string& talker, const std::string& file);

// What a stream that this talker draws may name: its own model alone, or nothing when it has none.
std::vector<StreamModel> drawn_stream_models(const std::string& talker);

// All that a stream may name: the talker's alone, or, when it is empty, every built-in talker's; and that of
// a file unless it is empty.
class StreamModelsAtHand {
  public:
    StreamModelsAtHand(const std::string& talker, const std::string& file);
    const std::vector<const StreamModel*>& all() const { return all_; }

  private:
    std::vector<StreamModel> models_;
    std::vector<const StreamModel*> all_;
};

// InputError("stream", ...) for a file that is none, or whose head is damaged.
Bytes read_stream_file(const std::string& file, const std::vector<const StreamModel*>& models);

}  // namespace viaface
