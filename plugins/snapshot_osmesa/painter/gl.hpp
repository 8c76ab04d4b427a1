// The OpenGL 3.3 functions that the painter calls, as pointers that OSMesa gives by name.
#pragma once

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

} // namespace foam::snapshot
