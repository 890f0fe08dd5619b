// A table of numbers in NumPy's file format, versions 1 to 3: "\x93NUMPY", u8 major, u8 minor, the header's
// length (u16, from version 2 on u32, little-endian), the header {'descr': '<f8', 'fortran_order': False,
// 'shape': (rows, columns), }, then the numbers. Read are tables of two dimensions, of floats of 4 or 8 bytes
// of either byte order.
#pragma once

#include <span>
#include <string>

#include "base/bytes.hpp"
#include "viapoints/motion.hpp"

namespace viaface {

inline constexpr std::size_t kLargestNpy = 256u << 20;  // bytes

bool is_npy(std::span<const std::uint8_t> bytes);

// InputError(field, ...) for other bytes, and for a file that is longer or shorter than its header says.
RowMatrix parse_npy(std::span<const std::uint8_t> bytes, const std::string& field = "motion");

}  // namespace viaface
