#include "facemodel/png.hpp"

#include <png.h>

#include <memory>
#include <stdexcept>

#include "base/error.hpp"

namespace viaface {
namespace {

struct FreeImage {
    void operator()(png_image* image) const { png_image_free(image); }
};

}  // namespace

Bytes encode_png(const Texture& texture) {
    if (texture.channels != 3 && texture.channels != 4) throw std::invalid_argument("PNG: 3 or 4 channels");
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(texture.width);
    image.height = static_cast<png_uint_32>(texture.height);
    image.format = texture.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, texture.pixels.data(), 0, nullptr);
    Bytes bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, texture.pixels.data(), 0, nullptr) == 0) {
        throw std::runtime_error(std::string("PNG: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

Texture decode_png(std::span<const std::uint8_t> bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, FreeImage> owner(&image);
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        throw InputError("png", image.message, "a PNG picture");
    }
    if (image.width > kLargestTexture || image.height > kLargestTexture) {
        throw InputError("png", std::to_string(image.width) + "x" + std::to_string(image.height),
                         "sides up to 8192 pixels");
    }
    Texture texture;
    texture.width = static_cast<int>(image.width);
    texture.height = static_cast<int>(image.height);
    texture.channels = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0 ? 4 : 3;
    image.format = texture.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    texture.pixels.resize(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, texture.pixels.data(), 0, nullptr) == 0) {
        throw InputError("png", image.message, "a PNG picture");
    }
    return texture;
}

}  // namespace viaface
