// The stream models that the commands of `viaface via` may use.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viapoints/stream_model.hpp"

namespace viaface {

// Of --talker and --model: a built-in talker's, or that of a file; none when both are empty.
std::unique_ptr<const StreamModel> stream_model_of(const std::string& talker, const std::string& file);

// All that a stream may name: every talker's, and that of a file unless it is empty.
class StreamModelsAtHand {
  public:
    explicit StreamModelsAtHand(const std::string& file);
    const std::vector<const StreamModel*>& all() const { return all_; }

  private:
    std::vector<StreamModel> models_;
    std::vector<const StreamModel*> all_;
};

// InputError("stream", ...) for a file that is none, or whose head is damaged.
Bytes read_stream_file(const std::string& file, const std::vector<const StreamModel*>& models);

}  // namespace viaface
