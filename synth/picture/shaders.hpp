// The shader sources. Each material's program is kVertexShader with kFragmentHead + the material's own
// `vec3 shade()`, + kFragmentTail.
#pragma once

#include <string>

#include "facemodel/face.hpp"

namespace viaface {

std::string vertex_shader();
std::string fragment_shader(Material material);
std::string background_vertex_shader();
std::string background_fragment_shader();

}  // namespace viaface
