// Draws a scene by OpenGL.
#pragma once

#include "offscreen.hpp"
#include "scene.hpp"

#include <opencv2/core.hpp>

#include <mutex>

namespace foam::snapshot {

/// One OpenGL context, used by one thread after the other: OSMesa runs contexts of one process in turn anyway, and a
/// picture is drawn by several threads of the driver's own.
class Rasterizer {
public:
    /// Throws Error(output) if there is no OpenGL 3.3.
    Rasterizer();
    ~Rasterizer();

    /// The picture in blue, green, red; `supersampling` is lowered where the driver's limits ask for it.
    cv::Mat3b draw(const Scene& scene, int supersampling, double mesh_opacity) const;
    /// Largest width and height that can be drawn.
    int largest() const { return largest_; }

private:
    struct Programs;
    mutable std::mutex mutex_;
    mutable Offscreen offscreen_;
    std::unique_ptr<const Programs> programs_;
    int largest_ = 0;
};

} // namespace foam::snapshot
