#include "rasterizer.hpp"

#include <foam/base/error.hpp>

#include <string>

namespace foam::snapshot {
namespace {

GLuint compile(const Gl& gl, GLenum kind, const char* source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* const parts[] = {shaders::prelude, source};
    gl.ShaderSource(shader, 2, parts, nullptr);
    gl.CompileShader(shader);
    return shader;
}

GLuint make_texture(const Gl& gl, GLint storage, GLenum layout, GLenum type, int width, int height) {
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, storage, width, height, 0, layout, type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

} // namespace

GLuint make_program(const Gl& gl, const char* vertex, const char* fragment) {
    const GLuint program = gl.CreateProgram();
    for (const GLuint shader : {compile(gl, GL_VERTEX_SHADER, vertex), compile(gl, GL_FRAGMENT_SHADER, fragment)}) {
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader); // freed when it is no longer attached
    }
    gl.LinkProgram(program);
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) {
        std::string report(2048, '\0');
        GLsizei length = 0;
        gl.GetProgramInfoLog(program, static_cast<GLsizei>(report.size()), &length, report.data());
        report.resize(static_cast<std::size_t>(length));
        throw Error(ErrorCode::internal, "snapshot.osmesa: a shader program does not link: " + report);
    }
    return program;
}

Target::Target(const Gl& gl, int width, int height, bool with_depth) : gl_(gl), width_(width), height_(height) {
    gl.GenFramebuffers(1, &framebuffer_);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    colour_ = make_texture(gl, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    if (with_depth) {
        depth_ = make_texture(gl, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, width, height);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
    }
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        this->~Target();
        throw Error(ErrorCode::output, "snapshot.osmesa: OSMesa cannot draw into a picture of " +
                                           std::to_string(width) + " x " + std::to_string(height) +
                                           " samples; remedy: a smaller picture or less supersampling");
    }
}

Target::~Target() {
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteTextures(1, &colour_);
    gl_.DeleteTextures(1, &depth_); // zero is ignored
}

void Target::begin(float background) const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.Viewport(0, 0, width_, height_);
    gl_.ClearColor(background, background, background, background);
    gl_.Clear(GL_COLOR_BUFFER_BIT | (depth_ != 0 ? GL_DEPTH_BUFFER_BIT : 0u));
}

Vertices::Vertices(const Gl& gl, const void* data, std::size_t bytes, std::size_t stride,
                   std::initializer_list<Attribute> attributes, bool per_instance)
    : gl_(gl) {
    gl.GenVertexArrays(1, &array_);
    gl.BindVertexArray(array_);
    gl.GenBuffers(1, &buffer_);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
    GLuint location = 0;
    for (const Attribute& attribute : attributes) {
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, attribute.components, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                               reinterpret_cast<const void*>(attribute.offset));
        gl.VertexAttribDivisor(location, per_instance ? 1 : 0);
        ++location;
    }
}

Vertices::~Vertices() {
    gl_.DeleteVertexArrays(1, &array_);
    gl_.DeleteBuffers(1, &buffer_);
}

} // namespace foam::snapshot
