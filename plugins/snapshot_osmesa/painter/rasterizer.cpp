#include "rasterizer.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>

#include <algorithm>
#include <cstddef>

namespace foam::snapshot {

struct Rasterizer::Programs {
    GLuint facets, glass, balls, compose;
};

namespace {

/// Sets the uniforms that all programs for geometry have.
void use(const Gl& gl, GLuint program, const Scene& scene, const View& view, int factor) {
    gl.UseProgram(program);
    const auto samples = static_cast<float>(factor);
    gl.Uniform2f(gl.GetUniformLocation(program, "middle"), samples * view.middle[0], samples * view.middle[1]);
    gl.Uniform2f(gl.GetUniformLocation(program, "size"), samples * static_cast<float>(scene.width),
                 samples * static_cast<float>(scene.height));
    gl.Uniform1f(gl.GetUniformLocation(program, "depth"), scene.depth);
    gl.Uniform1f(gl.GetUniformLocation(program, "factor"), samples);
}

void draw_corners(const Gl& gl, const std::vector<Corner>& corners) {
    if (corners.empty()) {
        return;
    }
    const Vertices vertices(gl, corners.data(), corners.size() * sizeof(Corner), sizeof(Corner),
                            {{3, offsetof(Corner, position)},
                             {3, offsetof(Corner, normal)},
                             {3, offsetof(Corner, colour)},
                             {1, offsetof(Corner, edges)}},
                            false);
    gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
}

void draw_balls(const Gl& gl, const std::vector<Ball>& balls) {
    if (balls.empty()) {
        return;
    }
    const Vertices vertices(gl, balls.data(), balls.size() * sizeof(Ball), sizeof(Ball),
                            {{3, offsetof(Ball, center)},
                             {1, offsetof(Ball, radius)},
                             {3, offsetof(Ball, colour)},
                             {1, offsetof(Ball, identity)}},
                            true);
    gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(balls.size()));
}

void bind(const Gl& gl, GLuint program, GLint unit, const char* name, GLuint texture) {
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.Uniform1i(gl.GetUniformLocation(program, name), unit);
}

/// Composes the parts of the picture that are drawn: most of a picture is background.
void compose(const Gl& gl, GLuint program, const Scene& scene, const Target& solid, const Target& glass, int factor,
             double opacity) {
    gl.UseProgram(program);
    bind(gl, program, 0, "solid_colour", solid.colour());
    bind(gl, program, 1, "solid_depth", solid.depth());
    bind(gl, program, 2, "glass_normal", glass.colour());
    bind(gl, program, 3, "glass_depth", glass.depth());
    gl.Uniform1i(gl.GetUniformLocation(program, "samples"), factor);
    gl.Uniform1f(gl.GetUniformLocation(program, "opacity"), static_cast<float>(opacity));
    gl.Uniform1f(gl.GetUniformLocation(program, "fading"), 0.25f);
    GLuint array = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.Enable(GL_SCISSOR_TEST);
    for (const View& view : scene.views) {
        const Drawn part = drawn(scene, view);
        gl.Scissor(part.left, part.bottom, part.width, part.height);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl.Disable(GL_SCISSOR_TEST);
    gl.DeleteVertexArrays(1, &array);
    gl.ActiveTexture(GL_TEXTURE0);
}

/// Returns the last drawing, upper row first.
cv::Mat3b read_pixels(const Gl& gl, int width, int height) {
    cv::Mat4b rows(height, width);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data);
    cv::Mat3b picture(height, width);
    CancellationCounter asking(64);
    for (int y = 0; y < height; ++y) {
        asking.check();
        for (int x = 0; x < width; ++x) {
            const cv::Vec4b& rgba = rows(height - 1 - y, x);
            picture(y, x) = {rgba[2], rgba[1], rgba[0]};
        }
    }
    return picture;
}

/// Returns the supersampling within the driver's limit and 64 million samples in all.
int affordable(int supersampling, int width, int height, int largest) {
    while (supersampling > 1 && (std::max(width, height) * supersampling > largest ||
                                 1.0 * width * height * supersampling * supersampling > 64e6)) {
        --supersampling;
    }
    return supersampling;
}

} // namespace

Rasterizer::Rasterizer() {
    const Offscreen::Current current(offscreen_);
    const Gl& gl = current.gl();
    programs_ = std::make_unique<const Programs>(
        Programs{make_program(gl, shaders::facet_vertex, shaders::facet_fragment),
                 make_program(gl, shaders::facet_vertex, shaders::glass_fragment),
                 make_program(gl, shaders::ball_vertex, shaders::ball_fragment),
                 make_program(gl, shaders::compose_vertex, shaders::compose_fragment)});
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_);
}

Rasterizer::~Rasterizer() = default;

cv::Mat3b Rasterizer::draw(const Scene& scene, int supersampling, double mesh_opacity) const {
    const std::lock_guard lock(mutex_);
    const Offscreen::Current current(offscreen_);
    const Gl& gl = current.gl();
    const int factor = affordable(supersampling, scene.width, scene.height, largest_);
    const Target solid(gl, factor * scene.width, factor * scene.height, true);
    const Target glass(gl, factor * scene.width, factor * scene.height, true);
    const Target picture(gl, scene.width, scene.height, false);

    const auto end_step = [&] { // otherwise the driver defers the drawing
        gl.Finish();
        check_cancelled();
    };
    gl.Enable(GL_DEPTH_TEST);
    solid.begin();
    for (const View& view : scene.views) {
        end_step();
        use(gl, programs_->facets, scene, view, factor);
        draw_corners(gl, view.facets);
        use(gl, programs_->balls, scene, view, factor);
        draw_balls(gl, view.balls);
    }
    glass.begin();
    for (const View& view : scene.views) {
        end_step();
        use(gl, programs_->glass, scene, view, factor);
        draw_corners(gl, view.glass);
    }
    gl.Disable(GL_DEPTH_TEST);
    end_step();
    picture.begin(1);
    compose(gl, programs_->compose, scene, solid, glass, factor, mesh_opacity);
    end_step();
    cv::Mat3b pixels = read_pixels(gl, scene.width, scene.height);
    if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
        throw Error(ErrorCode::output,
                    "snapshot.osmesa: OpenGL error " + std::to_string(error) +
                        (error == GL_OUT_OF_MEMORY ? " (out of memory); remedy: a smaller picture" : " while drawing"));
    }
    return pixels;
}

} // namespace foam::snapshot
