// Motion drawn while it arrives as a stream of via points: rows at an even rate, as soon as the packet that
// tells them is there (via_stream_live.hpp).
#pragma once

#include <deque>

#include "synth/render/live.hpp"
#include "viapoints/via_stream_live.hpp"

namespace viaface {

class LiveVia {
  public:
    // `in` and the models outlive it.
    LiveVia(std::istream& in, std::vector<const StreamModel*> models);
    // InputError("motion", ...) for bytes that begin no stream.
    std::optional<LiveRow> next();
    std::string describe_damage() const;

  private:
    void keep(const Motion& rows);

    std::istream& in_;
    LiveStreamDecoder decoder_;
    std::deque<LiveRow> rows_;
    bool ended_ = false;
};

// Whether what comes is a stream of via points; waits for the first byte and takes none.
bool begins_via(std::istream& in);

}  // namespace viaface
