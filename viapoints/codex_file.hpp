// The codex as bytes: kind 1 of FORMAT.md. Reading gives what was written but for rounding: no point moves by
// over 0.02 mm, times move by under 1/1000 of their phone, durations by under 0.05 ms. What was read is
// written to the same bytes again.
#pragma once

#include "base/bytes.hpp"
#include "viapoints/codex.hpp"

namespace viaface {

// Steps of the components, mm, so that rounding moves no point by over 0.019 mm (FORMAT.md, RECI).
Eigen::VectorXd quantisation_steps(const ConfigurationBasis& basis);

// std::invalid_argument for what the format cannot hold: a phone over 6.5 s, over 255 via points, a component
// over 1000 mm.
Bytes write_codex(const Codex& codex);

// std::runtime_error (nested) that names the chunk and the byte. Counts are checked against the bytes that
// are there before anything is allocated.
Codex read_codex(std::span<const std::uint8_t> bytes);

}  // namespace viaface
