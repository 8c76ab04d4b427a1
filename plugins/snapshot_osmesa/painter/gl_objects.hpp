// OpenGL objects that free themselves.
#pragma once

#include "gl.hpp"

#include <initializer_list>

namespace foam::snapshot {

/// Returns a linked shader program with the lifetime of its context.
GLuint make_program(const Gl& gl, const char* vertex, const char* fragment);

/// A colour texture, 8 bits per channel, with an optional depth texture, as a render target.
class Target {
public:
    /// Makes the textures. Throws Error(output) if the driver cannot draw into them.
    Target(const Gl& gl, int width, int height, bool with_depth);
    ~Target();
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    /// Makes it the current render target, with infinite depth. `background`: of all four channels, 0 to 1.
    void begin(float background = 0) const;
    GLuint colour() const { return colour_; }
    GLuint depth() const { return depth_; }

private:
    const Gl& gl_;
    int width_, height_;
    GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

/// The vertices of one draw call.
class Vertices {
public:
    struct Attribute {
        GLint components;
        std::size_t offset; ///< bytes from the start of a vertex
    };
    /// Uploads the vertices. `per_instance`: each entry belongs to a whole instance, not to a corner.
    Vertices(const Gl& gl, const void* data, std::size_t bytes, std::size_t stride,
             std::initializer_list<Attribute> attributes, bool per_instance);
    ~Vertices();
    Vertices(const Vertices&) = delete;
    Vertices& operator=(const Vertices&) = delete;

private:
    const Gl& gl_;
    GLuint array_ = 0, buffer_ = 0;
};

} // namespace foam::snapshot
