// A lip model as bytes, all little-endian:
//
//   "VIALIPS\n"               8 bytes
//   u32 format                1
//   u32 modes M               1 to 48
//   u32 frames                learned from
//   u32 size, bytes           provenance: UTF-8, at most 4096 bytes, no control characters
//   f64 noise_mm              mm
//   f64 left_over             mm^2
//   f64 total_variance        mm^2
//   f64 rest[612]             x y z of node 0 first, mm, head frame; so are mean and modes
//   f64 mean[612]             mm
//   f64 variance[M]           mm^2, positive, not rising
//   f64 modes[M][612]         orthonormal within 1e-6
//   u32 crc                   CRC-32 of all bytes before it
#pragma once

#include <span>

#include "base/bytes.hpp"
#include "lipmodel/modes.hpp"

namespace viaface {

Bytes write_lip_model(const LipModel& model);

// InputError(field, what was met, what is allowed) for anything that write_lip_model does not write.
LipModel read_lip_model(std::span<const std::uint8_t> bytes, const std::string& field = "lips");

}  // namespace viaface
