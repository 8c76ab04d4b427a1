#include "plain_picture.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/inscribed_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace foam::python {
namespace {

using Colour = std::array<double, 3>;

constexpr int samples = 2; ///< a pixel, along each side
constexpr Colour background{1, 1, 1}, sphere_colour{0.35, 0.56, 0.85}, grey{0.62, 0.62, 0.62};

/// Three corners on the screen, the third number towards the eye, and a lit colour.
struct Facet {
    std::array<Vec3, 3> corners;
    Colour colour;
};

/// The axes of the eye: right, up and towards it.
struct Eye {
    Vec3 right, up, towards;

    Eye() {
        constexpr double azimuth = -55 * std::numbers::pi / 180, elevation = 20 * std::numbers::pi / 180;
        towards = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)};
        right = normalized(cross(Vec3{0, 0, 1}, towards));
        up = cross(towards, right);
    }
    Vec3 seen(const Vec3& p) const { return {dot(p, right), dot(p, up), dot(p, towards)}; }
    /// Returns how bright a face is: light comes from above the eye's right shoulder, and some from everywhere.
    double light(const Vec3& normal) const {
        const Vec3 lamp = normalized(towards + up * 0.6 + right * 0.3);
        return 0.35 + 0.65 * std::max(0.0, std::abs(dot(normal, lamp)));
    }
};

/// Samples with the nearest colour and its depth.
struct Canvas {
    int width, height;
    std::vector<double> depth;
    std::vector<Colour> colour;

    Canvas(int w, int h)
        : width(w), height(h),
          depth(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), -std::numeric_limits<double>::infinity()),
          colour(depth.size(), background) {}

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    /// Draws the samples whose middles lie in the facet, by barycentric coordinates.
    void draw(const Facet& facet) {
        const auto& [a, b, c] = facet.corners;
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) {
            return;
        }
        const auto first = [](double low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5))); };
        const auto last = [](double high, int end) {
            return std::min(end - 1, static_cast<int>(std::floor(high - 0.5)));
        };
        for (int y = first(std::min({a.y, b.y, c.y})); y <= last(std::max({a.y, b.y, c.y}), height); ++y) {
            for (int x = first(std::min({a.x, b.x, c.x})); x <= last(std::max({a.x, b.x, c.x}), width); ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double s = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
                const double t = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
                if (s < 0 || t < 0 || s + t > 1) {
                    continue;
                }
                const double z = a.z + s * (b.z - a.z) + t * (c.z - a.z);
                if (const std::size_t i = index(x, y); z > depth[i]) {
                    depth[i] = z;
                    colour[i] = facet.colour;
                }
            }
        }
    }
};

Colour lit(const Colour& colour, double light) {
    return {colour[0] * light, colour[1] * light, colour[2] * light};
}

void add_facets(std::vector<Facet>& facets, const Mesh& mesh, const Pose& pose,
                const std::vector<std::uint32_t>& colours, const Colour& plain, const Eye& eye) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = pose * mesh.vertices[mesh.triangles[t][k]];
        }
        const Vec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (squared_norm(across) == 0) {
            continue;
        }
        const std::uint32_t own = t < colours.size() ? colours[t] : 0;
        const auto part = [own](unsigned shift) { return (own >> shift & 255) / 255.0; };
        const Colour colour = own == 0 ? plain : Colour{part(24), part(16), part(8)};
        facets.push_back({{eye.seen(corners[0]), eye.seen(corners[1]), eye.seen(corners[2])},
                          lit(colour, eye.light(normalized(across)))});
    }
}

/// Moves facets to the middle of the canvas, as large as fits.
void fit(std::array<std::vector<Facet>*, 2> lists, const Canvas& canvas) {
    Box bounds;
    for (const std::vector<Facet>* facets : lists) {
        for (const Facet& facet : *facets) {
            for (const Vec3& corner : facet.corners) {
                bounds.add(corner);
            }
        }
    }
    constexpr double filled = 0.92;
    const Vec3 size = bounds.size(), middle = bounds.center();
    const double scale =
        filled * std::min(canvas.width / std::max(size.x, 1e-300), canvas.height / std::max(size.y, 1e-300));
    for (std::vector<Facet>* facets : lists) {
        for (Facet& facet : *facets) {
            for (Vec3& corner : facet.corners) {
                corner = {canvas.width / 2.0 + scale * (corner.x - middle.x),
                          canvas.height / 2.0 - scale * (corner.y - middle.y), scale * corner.z};
            }
        }
    }
}

/// Blends a translucent layer over a canvas: fainter where it is behind.
void blend(Canvas& canvas, const Canvas& layer) {
    for (std::size_t i = 0; i < canvas.colour.size(); ++i) {
        if (std::isfinite(layer.depth[i])) {
            const double share = layer.depth[i] > canvas.depth[i] ? 0.5 : 0.2;
            for (std::size_t k = 0; k < 3; ++k) {
                canvas.colour[i][k] += share * (layer.colour[i][k] - canvas.colour[i][k]);
            }
        }
    }
}

/// Returns the means of the samples of each pixel.
std::vector<std::uint8_t> pixels_of(const Canvas& canvas) {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < canvas.height; y += samples) {
        for (int x = 0; x < canvas.width; x += samples) {
            for (std::size_t k = 0; k < 3; ++k) {
                double sum = 0;
                for (int s = 0; s < samples * samples; ++s) {
                    sum += canvas.colour[canvas.index(x + s % samples, y + s / samples)][k];
                }
                const double mean = std::clamp(sum / (samples * samples), 0.0, 1.0);
                bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * mean)));
            }
        }
    }
    return bytes;
}

} // namespace

std::vector<std::uint8_t> plain_picture(const Panel& panel, int width, int height) {
    const Eye eye;
    std::vector<Facet> opaque, translucent;
    const Mesh ball = icosphere(4);
    for (const Sphere& sphere : panel.spheres) {
        Mesh mesh = ball;
        for (Vec3& p : mesh.vertices) {
            p = p * sphere.radius;
        }
        add_facets(opaque, mesh, Pose{.translation = sphere.center}, {}, sphere_colour, eye);
        check_cancelled();
    }
    for (const FigureMesh& mesh : panel.meshes) {
        add_facets(mesh.translucent ? translucent : opaque, *mesh.mesh, mesh.pose, mesh.colours, grey, eye);
    }
    Canvas canvas(width * samples, height * samples), layer = canvas;
    fit({&opaque, &translucent}, canvas);
    for (const Facet& facet : opaque) {
        canvas.draw(facet);
    }
    check_cancelled();
    for (const Facet& facet : translucent) {
        layer.draw(facet);
    }
    blend(canvas, layer);
    return pixels_of(canvas);
}

} // namespace foam::python
