// How each material answers to light: the shader programs, the textures they read and the lights, which stand
// with the camera. Linear light in, sRGB out through a filmic curve (J. Hejl and R. Burgess-Dawson, "Filmic
// tone mapping for real-time rendering", SIGGRAPH 2010 course). Skin: normals blurred and wrapped per
// channel stand for light that travels under it (C. de Mesa et al. and A. Gritz's wrapped diffuse; J. Jimenez
// and D. Gutierrez, GPU Pro, 2010, for the look aimed at), two GGX lobes for its oil.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "synth/picture/gl.hpp"
#include "synth/picture/view.hpp"

namespace viaface {

enum VertexAttribute : GLuint {
    kPlaceAttribute,
    kNormalAttribute,
    kLightAttribute,
    kUvAttribute,
    kTangentAttribute
};

bool two_sided(Material material);

class Shading {
  public:
    Shading(const Face& face, const View& view, const Camera& camera);

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
