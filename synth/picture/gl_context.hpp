// An OpenGL 3.3 core context without a window. All names made in a context die with it.
#pragma once

#include <memory>

namespace viaface {

class GlContext {
  public:
    virtual ~GlContext() = default;
    // GL calls of this thread go to this context from now on. A context serves one thread at a time.
    virtual void make_current() = 0;
};

// Mesa's software rasteriser in this process. Throws std::runtime_error where it cannot be had.
std::unique_ptr<GlContext> make_osmesa_context();

}  // namespace viaface
