// The head of a stream: what a receiver must know before the first packet (FORMAT.md, kind 2).
#pragma once

#include "viapoints/stream_blends.hpp"
#include "viapoints/stream_directions.hpp"
#include "viapoints/stream_model.hpp"

namespace viaface {

struct StreamHead {
    std::string talker;  // empty: the basis stands in the stream
    std::uint32_t model_identity = 0;
    int table = 0;                  // of the talker's model; of a stream without one, unused
    std::vector<int> shared_modes;  // those of the talker's basis that are used, rising
    BlendWeights blends;            // of its other modes
    StreamDirections directions;    // within its modes
    double start_s = 0;             // the time of tick 0
    int ticks_per_s = 30;
    std::uint32_t longest_segment = 300;  // ticks
    double bound_mm = 1, step_mm = 5;     // as float
    std::vector<int> points;              // whose motion it holds
};

// What drawing needs: the head's basis whole and its statistics for as many components.
struct StreamTools {
    StreamHead head;
    ConfigurationBasis basis;
    StreamStatistics statistics;
};

// The model's modes that a stream uses, then its blends, then its directions.
ConfigurationBasis shared_basis(const StreamModel& model, const StreamHead& head);
// What is known beforehand of their components.
StreamStatistics shared_statistics(const StreamModel& model, const StreamHead& head);
// How many these are.
Eigen::Index shared_count(const StreamHead& head);

Bytes write_stream_head(const StreamTools& tools);

struct ReadHead {
    StreamTools tools;
    std::size_t size = 0;  // bytes before the first packet
};

// `models` are those at hand. InputError("talker", ...) for a stream whose model is not among them;
// std::runtime_error for damage.
ReadHead read_stream_head(std::span<const std::uint8_t> bytes, std::span<const StreamModel* const> models);
// The head alone, for a receiver that has to find the model first.
StreamHead peek_stream_head(std::span<const std::uint8_t> bytes);

}  // namespace viaface
