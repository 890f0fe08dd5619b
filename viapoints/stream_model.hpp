// What sender and receiver know of a talker before a stream begins: a basis, and a coder's statistics at
// several bounds. Learned from motions; a file of its own (FORMAT.md, kind 3) in the talker's folder.
#pragma once

#include <string>

#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_statistics.hpp"

namespace viaface {

struct StreamModel {
    std::string name;                      // the talker's
    ConfigurationBasis basis;              // as stored_basis gives it
    std::vector<StreamStatistics> tables;  // rising by bound_mm

    // CRC-32 of its bytes: a stream names the model by it.
    std::uint32_t identity() const;
    // The table whose bound is nearest, by ratio; tables must not be empty.
    std::size_t table_for(double bound_mm) const;
};

// Equal models give equal bytes.
Bytes write_stream_model(const StreamModel& model);
// std::runtime_error that names the chunk and the byte for whatever is not as FORMAT.md has it.
StreamModel read_stream_model(std::span<const std::uint8_t> bytes);

}  // namespace viaface
