// Files of NumPy made by hand.
#pragma once

#include <string>
#include <string_view>

#include "base/bytes.hpp"

namespace viaface {

inline Bytes npy_head(std::string_view header, int major = 1) {
    ByteWriter writer;
    writer.put_text("\x93NUMPY");
    writer.put(static_cast<std::uint8_t>(major));
    writer.put(std::uint8_t{0});
    if (major == 1) {
        writer.put(static_cast<std::uint16_t>(header.size()));
    } else {
        writer.put(static_cast<std::uint32_t>(header.size()));
    }
    writer.put_text(header);
    return writer.bytes();
}

template <class T>
Bytes npy_file(std::string_view header, const std::vector<T>& numbers, int major = 1) {
    ByteWriter writer;
    writer.put_bytes(npy_head(header, major));
    for (const T number : numbers) writer.put(number);
    return writer.bytes();
}

}  // namespace viaface
