#include "synth/picture/shading.hpp"

#include "synth/picture/background.hpp"
#include "synth/picture/shaders.hpp"

namespace viaface {
namespace {

enum Unit : int { kBaseUnit, kShadeUnit, kNormalUnit };

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

GLuint texture_or(const Texture& texture, const Texture& otherwise) {
    return make_texture(texture.pixels.empty() ? otherwise : texture);
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
    program.set("shade_texture", kShadeUnit);
    program.set("normal_texture", kNormalUnit);
}

bool two_sided(Material material) {
    return material == Material::kMouth || material == Material::kLash || material == Material::kCloth;
}

}  // namespace

Shading::Shading(const Face& face, const View& view, const Camera& camera) {
    programs_.reserve(kMaterials);
    for (int i = 0; i < kMaterials; ++i) {
        const auto material = static_cast<Material>(i);
        const Surface& surface = face.surfaces[i];
        const auto [base, roughness] = plain(material);
        programs_.emplace_back(vertex_shader(), fragment_shader(material));
        prepare(programs_.back(), camera, material);
        bound_[i] = {&programs_.back(), texture_or(surface.base_colour, one_pixel(base[0], base[1], base[2])),
                     texture_or(surface.occlusion_roughness, one_pixel(255, roughness, 0)),
                     texture_or(surface.normal, one_pixel(128, 128, 255))};
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
    bind(kShadeUnit, bound.shade);
    bind(kNormalUnit, bound.normal);
    (two_sided(material) ? glDisable : glEnable)(GL_CULL_FACE);
    const bool lash = material == Material::kLash;
    (lash ? glEnable : glDisable)(GL_BLEND);
    glDepthMask(lash ? GL_FALSE : GL_TRUE);
}

}  // namespace viaface
