// Draws a scene with OpenGL.
#pragma once

#include "offscreen.hpp"
#include "scene.hpp"

#include <opencv2/core.hpp>

#include <mutex>

namespace foam::snapshot {

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
