// An OpenGL context without a screen.
#pragma once

#include "gl.hpp"

#include <memory>

namespace foam::snapshot {

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
