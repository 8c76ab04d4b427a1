#include "rasterizer.hpp"

#include <foam/base/error.hpp>

#include <GL/osmesa.h>

#include <array>
#include <string>

namespace foam::snapshot {

struct Offscreen::Data {
    OSMesaContext context = nullptr;
    std::array<unsigned char, 16 * 16 * 4> buffer{}; // OSMesa needs one; all drawing goes to framebuffer objects
    Gl gl;
};

namespace {

void load(Gl& gl) {
#define FOAM_GL_LOAD(name, NAME)                                                                                       \
    gl.name = reinterpret_cast<PFNGL##NAME##PROC>(OSMesaGetProcAddress("gl" #name));                                   \
    if (gl.name == nullptr) {                                                                                          \
        throw Error(ErrorCode::output, "snapshot.osmesa: this OSMesa lacks the OpenGL function gl" #name               \
                                       "; remedy: install libosmesa6 22 or newer");                                    \
    }
    FOAM_GL_FUNCTIONS(FOAM_GL_LOAD)
#undef FOAM_GL_LOAD
}

} // namespace

Offscreen::Offscreen() : data_(std::make_unique<Data>()) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    data_->context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (data_->context == nullptr) {
        throw Error(
            ErrorCode::output,
            "snapshot.osmesa: OSMesa cannot create an OpenGL 3.3 core context; remedy: install libosmesa6 22 or "
            "newer, and unset GALLIUM_DRIVER and MESA_GL_VERSION_OVERRIDE");
    }
    try {
        const Current current(*this);
        load(data_->gl);
    } catch (...) {
        OSMesaDestroyContext(data_->context);
        throw;
    }
}

Offscreen::~Offscreen() {
    OSMesaDestroyContext(data_->context);
}

Offscreen::Current::Current(Offscreen& offscreen) : offscreen_(offscreen) {
    Data& data = *offscreen.data_;
    if (!OSMesaMakeCurrent(data.context, data.buffer.data(), GL_UNSIGNED_BYTE, 16, 16)) {
        throw Error(ErrorCode::output,
                    "snapshot.osmesa: OSMesa cannot make its context current on this thread; remedy: "
                    "close other off-screen contexts of the program");
    }
}

Offscreen::Current::~Current() {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
}

const Gl& Offscreen::Current::gl() const {
    return offscreen_.data_->gl;
}

} // namespace foam::snapshot
