// Pictures as PNG, 8 bits a channel. Equal pictures give equal bytes.
#pragma once

#include <span>

#include "base/bytes.hpp"
#include "facemodel/face.hpp"

namespace viaface {

inline constexpr int kLargestTexture = 8192;  // pixels, either side

Bytes encode_png(const Texture& texture);  // std::invalid_argument unless 3 or 4 channels
// RGB, or RGBA where the file has alpha. InputError("png", ...) for bytes that are none.
Texture decode_png(std::span<const std::uint8_t> bytes);

}  // namespace viaface
