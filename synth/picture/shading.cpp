#include "synth/picture/shading.hpp"

#include <algorithm>

#include "synth/picture/background.hpp"
#include "synth/picture/shaders.hpp"

namespace viaface {
namespace {

enum Unit : int { kBaseUnit, kDetailUnit };

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

// The texel of `texture` at a place of a picture of `side` columns and rows.
const std::uint8_t* texel(const Texture& texture, int x, int y, int width, int height) {
    const std::size_t row = std::size_t(y) * texture.height / height,
                      column = std::size_t(x) * texture.width / width;
    return &texture.pixels[(row * texture.width + column) * texture.channels];
}

// Two textures are read where glTF has three: colour with occlusion (or the lashes' cover), and the normal's
// slopes with roughness and thinness.
struct Packed {
    Texture base, detail;
};
Packed pack(const Surface& surface, Material material) {
    const auto [colour, roughness] = plain(material);
    const Texture plain_base = one_pixel(colour[0], colour[1], colour[2]);
    const Texture plain_shade = one_pixel(255, roughness, 0), level = one_pixel(128, 128, 255);
    const Texture& base = either(surface.base_colour, plain_base);
    const Texture& shade = either(surface.occlusion_roughness, plain_shade);
    const Texture& normal = either(surface.normal, level);
    const int width = std::max({base.width, shade.width, normal.width});
    const int height = std::max({base.height, shade.height, normal.height});
    Packed packed{{width, height, 4, {}}, {width, height, 4, {}}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto *b = texel(base, x, y, width, height), *s = texel(shade, x, y, width, height),
                       *n = texel(normal, x, y, width, height);
            const std::uint8_t fourth = material == Material::kLash && base.channels == 4 ? b[3] : s[0];
            packed.base.pixels.insert(packed.base.pixels.end(), {b[0], b[1], b[2], fourth});
            packed.detail.pixels.insert(packed.detail.pixels.end(), {n[0], n[1], s[1], s[2]});
        }
    }
    return packed;
}

void bind(int unit, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
}

constexpr float kLashesBefore = 3;  // mm: lashes are drawn over the lids they grow from

void prepare(const Program& program, const Camera& camera, Material material) {
    program.use();
    program.set("world_from_head", camera.world_from_head);
    program.set("clip_from_world", camera.clip_from_world);
    program.set("camera", camera.place);
    program.set("nearer", material == Material::kLash ? kLashesBefore : 0.0f);
    program.set("base_texture", kBaseUnit);
    program.set("detail_texture", kDetailUnit);
}

}  // namespace

bool two_sided(Material material) {
    return material == Material::kMouth || material == Material::kLash || material == Material::kCloth;
}

Shading::Shading(const Face& face, const View& view, const Camera& camera) {
    programs_.reserve(kMaterials);
    for (int i = 0; i < kMaterials; ++i) {
        const auto material = static_cast<Material>(i);
        const Packed packed = pack(face.surfaces[i], material);
        programs_.emplace_back(vertex_shader(), fragment_shader(material));
        prepare(programs_.back(), camera, material);
        bound_[i] = {&programs_.back(), make_texture(packed.base), make_texture(packed.detail)};
    }
    background_program_.emplace(background_vertex_shader(), background_fragment_shader());
    background_program_->use();
    background_program_->set("picture", kBaseUnit);
    background_ = make_texture(make_background(view));
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    check_gl("preparing the shading");
}

void Shading::draw_background() const {
    glDepthMask(GL_TRUE);  // clearing obeys it
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    background_program_->use();
    bind(kBaseUnit, background_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

void Shading::begin(Material material) const {
    const Bound& bound = bound_[static_cast<std::size_t>(material)];
    bound.program->use();
    bind(kBaseUnit, bound.base);
    bind(kDetailUnit, bound.detail);
    (two_sided(material) ? glDisable : glEnable)(GL_CULL_FACE);
    const bool lash = material == Material::kLash;
    (lash ? glEnable : glDisable)(GL_BLEND);
    glDepthMask(lash ? GL_FALSE : GL_TRUE);
}

}  // namespace viaface
