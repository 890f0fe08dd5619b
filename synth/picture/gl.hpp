// OpenGL objects with their errors: programs, buffers, textures, and the multisampled picture that is drawn
// to. Every function needs a current context; names die with the context.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <Eigen/Core>
#include <string>

#include "facemodel/face.hpp"
#include "synth/picture/rect.hpp"

namespace viaface {

// Throws std::runtime_error "doing: GL error 0x502" when GL has an error pending.
void check_gl(const char* doing);

class Program {
  public:
    // Throws std::runtime_error with the compiler's log.
    Program(const std::string& vertex_source, const std::string& fragment_source);

    void use() const { glUseProgram(name_); }
    void set(const char* uniform, int value) const { glUniform1i(place(uniform), value); }
    void set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }
    void set(const char* uniform, const Eigen::Vector3d& value) const;
    void set(const char* uniform, const Eigen::Matrix4d& value) const;

  private:
    int place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }
    GLuint name_ = 0;
};

// A mip-mapped texture of 8-bit channels, repeated sideways.
GLuint make_texture(const Texture& texture);

GLuint make_buffer();

// A picture of four samples per pixel with its depth, and the plain picture it is resolved to.
class MultisampledPicture {
  public:
    static constexpr int kSamples = 4;

    MultisampledPicture(int width, int height);

    void bind() const;
    // Resolves and reads a rectangle into [height x width x 4] bytes, bottom row first. Binds other pictures.
    void read(const Rect& rect, std::uint8_t* rgba) const;

  private:
    int width_, height_;
    GLuint samples_ = 0, resolved_ = 0;  // framebuffers
};

}  // namespace viaface
