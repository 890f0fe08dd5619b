#include "synth/picture/packed_textures.hpp"

#include <algorithm>
#include <cstring>

#include "synth/picture/view.hpp"

namespace viaface {
namespace {

struct Plain {
    Rgb base;
    std::uint8_t roughness;
};

// Where a face brings no texture.
Plain plain(Material material) {
    switch (material) {
        case Material::kSkin:
            return {{206, 160, 141}, 130};
        case Material::kLips:
            return {{176, 104, 98}, 90};
        case Material::kMouth:
            return {{120, 52, 50}, 80};
        case Material::kGums:
            return {{176, 92, 90}, 70};
        case Material::kTeeth:
            return {{226, 214, 190}, 55};
        case Material::kTongue:
            return {{186, 102, 98}, 80};
        case Material::kEye:
            return {{200, 190, 184}, 30};
        case Material::kLash:
            return {{26, 18, 14}, 150};
        case Material::kCloth:
            return {{38, 44, 56}, 220};
    }
    return {{128, 128, 128}, 128};
}

Texture one_pixel(std::uint8_t r, std::uint8_t g, std::uint8_t b) { return {1, 1, 3, {r, g, b}}; }

const Texture& either(const Texture& texture, const Texture& otherwise) {
    return texture.pixels.empty() ? otherwise : texture;
}

// Reads a texture as if it had `width` columns and `height` rows.
class Stretched {
  public:
    Stretched(const Texture& texture, int width, int height) : texture_(texture), height_(height) {
        for (int x = 0; x < width; ++x)
            columns_.push_back(std::size_t(x) * texture.width / width * texture.channels);
    }
    void go_to_row(int y) {
        const std::size_t row = std::size_t(y) * texture_.height / height_;
        row_ = &texture_.pixels[row * texture_.width * texture_.channels];
    }
    const std::uint8_t* at(int x) const { return row_ + columns_[x]; }

  private:
    const Texture& texture_;
    int height_;
    std::vector<std::size_t> columns_;  // bytes
    const std::uint8_t* row_ = nullptr;
};

Texture four_channels(int width, int height) {
    return {width, height, 4, std::vector<std::uint8_t>(std::size_t(4) * width * height)};
}

}  // namespace

PackedTextures pack(const Surface& surface, Material material) {
    const auto [colour, roughness] = plain(material);
    const Texture plain_base = one_pixel(colour[0], colour[1], colour[2]);
    const Texture plain_shade = one_pixel(255, roughness, 0), level = one_pixel(128, 128, 255);
    const Texture& base = either(surface.base_colour, plain_base);
    const Texture& shade = either(surface.occlusion_roughness, plain_shade);
    const Texture& normal = either(surface.normal, level);
    const int width = std::max({base.width, shade.width, normal.width});
    const int height = std::max({base.height, shade.height, normal.height});
    const bool cover = material == Material::kLash && base.channels == 4;
    Stretched b(base, width, height), s(shade, width, height), n(normal, width, height);
    PackedTextures packed{four_channels(width, height), four_channels(width, height)};
    std::uint8_t *to_base = packed.base.pixels.data(), *to_detail = packed.detail.pixels.data();
    for (int y = 0; y < height; ++y) {
        b.go_to_row(y), s.go_to_row(y), n.go_to_row(y);
        for (int x = 0; x < width; ++x, to_base += 4, to_detail += 4) {
            const std::uint8_t *at_b = b.at(x), *at_s = s.at(x), *at_n = n.at(x);
            const std::uint8_t rgba[4] = {at_b[0], at_b[1], at_b[2], cover ? at_b[3] : at_s[0]};
            const std::uint8_t rest[4] = {at_n[0], at_n[1], at_s[1], at_s[2]};
            std::memcpy(to_base, rgba, 4);
            std::memcpy(to_detail, rest, 4);
        }
    }
    return packed;
}

}  // namespace viaface
