#include "synth/picture/gl.hpp"

#include <sstream>
#include <stdexcept>

namespace viaface {
namespace {

GLuint compile(GLenum kind, const std::string& source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good != GL_TRUE) {
        char log[4096] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        throw std::runtime_error(std::string("compiling a shader: ") + log);
    }
    return shader;
}

GLuint make_renderbuffer(GLenum format, int samples, int width, int height) {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    return name;
}

GLuint make_framebuffer(GLuint colour, GLuint depth) {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    if (depth != 0) glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw std::runtime_error("the framebuffer is incomplete");
    }
    return name;
}

}  // namespace

void check_gl(const char* doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    std::ostringstream text;
    text << doing << ": GL error 0x" << std::hex << error;
    throw std::runtime_error(text.str());
}

Program::Program(const std::string& vertex_source, const std::string& fragment_source)
    : name_(glCreateProgram()) {
    for (const GLuint shader :
         {compile(GL_VERTEX_SHADER, vertex_source), compile(GL_FRAGMENT_SHADER, fragment_source)}) {
        glAttachShader(name_, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(name_);
    GLint good = 0;
    glGetProgramiv(name_, GL_LINK_STATUS, &good);
    if (good != GL_TRUE) {
        char log[4096] = "";
        glGetProgramInfoLog(name_, sizeof log, nullptr, log);
        throw std::runtime_error(std::string("linking a shader program: ") + log);
    }
}

void Program::set(const char* uniform, const Eigen::Vector3d& value) const {
    const Eigen::Vector3f single = value.cast<float>();
    glUniform3fv(place(uniform), 1, single.data());
}

void Program::set(const char* uniform, const Eigen::Matrix4d& value) const {
    const Eigen::Matrix4f single = value.cast<float>();
    glUniformMatrix4fv(place(uniform), 1, GL_FALSE, single.data());
}

GLuint make_texture(const Texture& texture) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const GLenum format = texture.channels == 4 ? GL_RGBA : GL_RGB;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, texture.width, texture.height, 0, format, GL_UNSIGNED_BYTE,
                 texture.pixels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glGenerateMipmap(GL_TEXTURE_2D);
    check_gl("uploading a texture");
    return name;
}

GLuint make_buffer() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
}

MultisampledPicture::MultisampledPicture(int width, int height) : width_(width), height_(height) {
    samples_ = make_framebuffer(make_renderbuffer(GL_RGBA8, kSamples, width, height),
                                make_renderbuffer(GL_DEPTH_COMPONENT24, kSamples, width, height));
    resolved_ = make_framebuffer(make_renderbuffer(GL_RGBA8, 0, width, height), 0);
    check_gl("making the picture's buffers");
}

void MultisampledPicture::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, samples_);
    glViewport(0, 0, width_, height_);
}

void MultisampledPicture::read(const Rect& rect, std::uint8_t* rgba) const {
    const int right = rect.left + rect.width, top = rect.bottom + rect.height;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    glBlitFramebuffer(rect.left, rect.bottom, right, top, rect.left, rect.bottom, right, top,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
    glPixelStorei(GL_PACK_ROW_LENGTH, width_);
    glReadPixels(rect.left, rect.bottom, rect.width, rect.height, GL_RGBA, GL_UNSIGNED_BYTE,
                 rgba + 4 * (std::size_t(rect.bottom) * width_ + rect.left));
    check_gl("reading the picture");
}

}  // namespace viaface
