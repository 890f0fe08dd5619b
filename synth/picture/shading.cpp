#include "synth/picture/shading.hpp"

#include "synth/picture/background.hpp"
#include "synth/picture/layers.hpp"
#include "synth/picture/packed_textures.hpp"
#include "synth/picture/shaders.hpp"

namespace viaface {
namespace {

enum Unit : int { kBaseUnit, kDetailUnit };

void bind(int unit, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
}

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

Shading::Shading(const Surfaces& surfaces, const View& view, const Camera& camera) {
    programs_.reserve(kMaterials);
    for (int i = 0; i < kMaterials; ++i) {
        const auto material = static_cast<Material>(i);
        const PackedTextures packed = pack(surfaces[i], material);
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
