// The shader sources: one vertex shader, and for each material a fragment shader of its own.
#pragma once

#include <string>

#include "facemodel/face.hpp"

namespace viaface {

std::string vertex_shader();
std::string fragment_shader(Material material);
std::string background_vertex_shader();
std::string background_fragment_shader();

}  // namespace viaface
