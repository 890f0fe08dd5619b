// How each material answers to light: the shader programs, the textures they read and the lights, which stand
// with the camera. Linear light in, sRGB out through a filmic curve (J. Hejl and R. Burgess-Dawson's, in
// H.-P. Duiker, "Filmic tonemapping for real-time rendering", SIGGRAPH 2010 course). Light that travels under
// the skin is stood in for by diffuse light wrapped round per channel (S. Green, "Real-time approximations to
// subsurface scattering", GPU Gems, 2004) on a smoother normal for red than for blue (W.-C. Ma et al., "Rapid
// acquisition of specular and diffuse normal maps", EGSR 2007); two GGX lobes are its oil. Departures: the
// key light alone casts a shadow, as key_shadow.hpp says; what the head keeps off itself of the rest is in
// the textures' occlusion, and of the mouth in MouthLight.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "synth/picture/gl.hpp"
#include "synth/picture/packed_textures.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

enum VertexAttribute : GLuint {
    kPlaceAttribute,
    kNormalAttribute,
    kLightAttribute,
    kUvAttribute,
    kTangentAttribute
};

class Shading {
  public:
    Shading(const Surfaces& surfaces, const View& view, const Camera& camera);

    void draw_background() const;         // whole scissor rectangle, depth cleared
    void begin(Material material) const;  // what is drawn next is of this material

  private:
    struct Bound {
        const Program* program = nullptr;
        GLuint base = 0, detail = 0;
    };

    std::vector<Program> programs_;
    std::array<Bound, kMaterials> bound_;
    std::optional<Program> background_program_;
    GLuint background_ = 0;
};

}  // namespace viaface
