// The scene as pixels: OpenGL without a window, its objects and shaders.
#pragma once

#include "scene.hpp"

#include <opencv2/core.hpp>

#include <initializer_list>
#include <memory>
#include <mutex>

// Before osmesa.h, whose gl.h would otherwise hide the core profile's declarations.
#include <GL/glcorearb.h>

namespace foam::snapshot {

#define FOAM_GL_FUNCTIONS(X)                                                                                           \
    X(ActiveTexture, ACTIVETEXTURE)                                                                                    \
    X(AttachShader, ATTACHSHADER)                                                                                      \
    X(BindBuffer, BINDBUFFER)                                                                                          \
    X(BindFramebuffer, BINDFRAMEBUFFER)                                                                                \
    X(BindTexture, BINDTEXTURE)                                                                                        \
    X(BindVertexArray, BINDVERTEXARRAY)                                                                                \
    X(BufferData, BUFFERDATA)                                                                                          \
    X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)                                                                  \
    X(Clear, CLEAR)                                                                                                    \
    X(ClearColor, CLEARCOLOR)                                                                                          \
    X(CompileShader, COMPILESHADER)                                                                                    \
    X(CreateProgram, CREATEPROGRAM)                                                                                    \
    X(CreateShader, CREATESHADER)                                                                                      \
    X(DeleteBuffers, DELETEBUFFERS)                                                                                    \
    X(DeleteFramebuffers, DELETEFRAMEBUFFERS)                                                                          \
    X(DeleteShader, DELETESHADER)                                                                                      \
    X(DeleteTextures, DELETETEXTURES)                                                                                  \
    X(DeleteVertexArrays, DELETEVERTEXARRAYS)                                                                          \
    X(Disable, DISABLE)                                                                                                \
    X(DrawArrays, DRAWARRAYS)                                                                                          \
    X(DrawArraysInstanced, DRAWARRAYSINSTANCED)                                                                        \
    X(Enable, ENABLE)                                                                                                  \
    X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY)                                                                \
    X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)                                                                      \
    X(GenBuffers, GENBUFFERS)                                                                                          \
    X(GenFramebuffers, GENFRAMEBUFFERS)                                                                                \
    X(GenTextures, GENTEXTURES)                                                                                        \
    X(GenVertexArrays, GENVERTEXARRAYS)                                                                                \
    X(GetError, GETERROR)                                                                                              \
    X(GetIntegerv, GETINTEGERV)                                                                                        \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                                                                            \
    X(GetProgramiv, GETPROGRAMIV)                                                                                      \
    X(GetUniformLocation, GETUNIFORMLOCATION)                                                                          \
    X(LinkProgram, LINKPROGRAM)                                                                                        \
    X(PixelStorei, PIXELSTOREI)                                                                                        \
    X(Finish, FINISH)                                                                                                  \
    X(ReadPixels, READPIXELS)                                                                                          \
    X(Scissor, SCISSOR)                                                                                                \
    X(ShaderSource, SHADERSOURCE)                                                                                      \
    X(TexImage2D, TEXIMAGE2D)                                                                                          \
    X(TexParameteri, TEXPARAMETERI)                                                                                    \
    X(Uniform1f, UNIFORM1F)                                                                                            \
    X(Uniform1i, UNIFORM1I)                                                                                            \
    X(Uniform2f, UNIFORM2F)                                                                                            \
    X(UseProgram, USEPROGRAM)                                                                                          \
    X(VertexAttribDivisor, VERTEXATTRIBDIVISOR)                                                                        \
    X(VertexAttribPointer, VERTEXATTRIBPOINTER)                                                                        \
    X(Viewport, VIEWPORT)

/// Function pointers, valid while the context that they were loaded in is current.
struct Gl {
#define FOAM_GL_POINTER(name, NAME) PFNGL##NAME##PROC name = nullptr;
    FOAM_GL_FUNCTIONS(FOAM_GL_POINTER)
#undef FOAM_GL_POINTER
};

/// An OpenGL 3.3 core context of OSMesa. One thread at a time may use it, during the lifetime of a Current.
class Offscreen {
public:
    /// Makes a context. Throws Error(output) if OSMesa cannot.
    Offscreen();
    ~Offscreen();
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;

    /// Makes the context current on this thread during its lifetime.
    class Current {
    public:
        explicit Current(Offscreen& offscreen);
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;
        const Gl& gl() const;

    private:
        Offscreen& offscreen_;
    };

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace foam::snapshot

namespace foam::snapshot::shaders {

extern const char* const prelude;          ///< the beginning of each: version, and light on a surface
extern const char* const facet_vertex;     ///< triangles, flat
extern const char* const facet_fragment;   ///< opaque triangles with their edges
extern const char* const glass_fragment;   ///< translucent triangles: normals only, shaded by compose_fragment
extern const char* const ball_vertex;      ///< one square per sphere
extern const char* const ball_fragment;    ///< exact spheres
extern const char* const compose_vertex;   ///< one triangle over the whole picture
extern const char* const compose_fragment; ///< layers, outlines and the mean over a pixel's samples

} // namespace foam::snapshot::shaders

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

/// One OpenGL context, used by one thread at a time: OSMesa runs the contexts of one process in turn anyway, and the
/// driver draws a picture with several threads.
class Rasterizer {
public:
    /// Makes the context. Throws Error(output) if there is no OpenGL 3.3.
    Rasterizer();
    ~Rasterizer();

    /// Returns the picture in blue, green, red. Reduces `supersampling` where the driver's limits require it.
    cv::Mat3b draw(const Scene& scene, int supersampling, double mesh_opacity) const;
    /// Returns the largest width and height.
    int largest() const { return largest_; }

private:
    struct Programs;
    mutable std::mutex mutex_;
    mutable Offscreen offscreen_;
    std::unique_ptr<const Programs> programs_;
    int largest_ = 0;
};

} // namespace foam::snapshot
