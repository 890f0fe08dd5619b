#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "synth/picture/gl_context.hpp"

namespace viaface {
namespace {

struct ContextDeleter {
    void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
};
using OwnedContext = std::unique_ptr<std::remove_pointer_t<OSMesaContext>, ContextDeleter>;

// Vectors of 512 bits crash in llvmpipe as Debian 12 ships it.
void refuse_wide_vectors() {
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    if (width != nullptr && std::atoi(width) > 256) {
        throw std::runtime_error("LP_NATIVE_VECTOR_WIDTH=" + std::string(width) + " is over 256");
    }
}

OwnedContext create() {
    const int wanted[] = {OSMESA_FORMAT,
                          OSMESA_RGBA,
                          OSMESA_PROFILE,
                          OSMESA_CORE_PROFILE,
                          OSMESA_CONTEXT_MAJOR_VERSION,
                          3,
                          OSMESA_CONTEXT_MINOR_VERSION,
                          3,
                          0};
    OwnedContext context(OSMesaCreateContextAttribs(wanted, nullptr));
    if (!context) throw std::runtime_error("OSMesa gives no OpenGL 3.3 core context");
    return context;
}

class OsmesaContext : public GlContext {
  public:
    OsmesaContext() {
        refuse_wide_vectors();
        context_ = create();
        make_current();
    }

    void make_current() override {
        if (OSMesaGetCurrentContext() == context_.get()) return;
        if (OSMesaMakeCurrent(context_.get(), unused_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) {
            throw std::runtime_error("OSMesa cannot make its context current");
        }
    }

  private:
    static constexpr int kSide = 4;
    std::array<std::uint8_t, 4 * kSide * kSide> unused_{};  // its own picture; we draw elsewhere
    OwnedContext context_;
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace viaface
