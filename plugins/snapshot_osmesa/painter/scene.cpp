#include "scene.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace foam::snapshot {
namespace {

/// The map from a panel's frame to pixels around the middle of its view.
struct Projection {
    const Camera& camera;
    Vec3 middle;
    double scale;

    Vec3 operator()(const Vec3& p) const { return (camera(p) - middle) * scale; }
};

void store(float (&target)[3], const Vec3& v) {
    target[0] = static_cast<float>(v.x);
    target[1] = static_cast<float>(v.y);
    target[2] = static_cast<float>(v.z);
}

void store_colour(float (&target)[3], std::uint32_t colour) {
    constexpr std::uint32_t grey = 0xdbe0e8ff;
    for (int channel = 0; channel < 3; ++channel) {
        const std::uint32_t byte = (colour != 0 ? colour : grey) >> (24 - 8 * channel) & 0xff;
        target[channel] = static_cast<float>(byte) / 255.0f;
    }
}

/// Appends the triangles of a mesh. Returns how many could not be drawn.
std::size_t add_mesh(const FigureMesh& item, const Projection& project, std::vector<Corner>& corners) {
    const Mesh& mesh = *item.mesh;
    std::vector<Vec3> points;
    points.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) {
        points.push_back(project(item.pose * vertex));
    }
    std::size_t dropped = 0;
    corners.reserve(corners.size() + 3 * mesh.triangles.size());
    CancellationCounter asking(8192);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        asking.check();
        const Triangle& t = mesh.triangles[i];
        if (std::max({t[0], t[1], t[2]}) >= points.size()) {
            ++dropped;
            continue;
        }
        const Vec3 a = points[t[0]], b = points[t[1]], c = points[t[2]];
        if (!drawable(a) || !drawable(b) || !drawable(c)) {
            ++dropped;
            continue;
        }
        const Vec3 normal = normalized(cross(normalized(b - a), normalized(c - a)));
        for (const Vec3& point : {a, b, c}) {
            Corner& corner = corners.emplace_back();
            store(corner.position, point);
            store(corner.normal, normal);
            store_colour(corner.colour, i < item.colours.size() ? item.colours[i] : 0);
            corner.edges = item.colours.empty() ? 1.0f : 0.0f;
        }
    }
    return dropped;
}

Ball make_ball(const Sphere& sphere, std::size_t index, const Projection& project, const RadiusRange& radii) {
    Ball ball{};
    store(ball.center, project(sphere.center));
    ball.radius = static_cast<float>(sphere.radius * project.scale);
    const Colour colour = colour_of(sphere.radius, radii.least, radii.most);
    for (int channel = 0; channel < 3; ++channel) {
        ball.colour[channel] = static_cast<float>(colour[static_cast<std::size_t>(channel)]) / 255.0f;
    }
    ball.identity = static_cast<float>(index % 250 + 1);
    return ball;
}

/// Returns how far the geometry of a view extends towards the eye or away from it, pixels.
float reach(const View& view) {
    float most = 1;
    for (const auto* corners : {&view.facets, &view.glass}) {
        for (const Corner& corner : *corners) {
            most = std::max(most, std::abs(corner.position[2]));
        }
    }
    for (const Ball& ball : view.balls) {
        most = std::max(most, std::abs(ball.center[2]) + ball.radius);
    }
    return most;
}

} // namespace

Drawn drawn(const Scene& scene, const View& view) {
    constexpr float outline = 2; // pixels beyond the geometry
    std::array<float, 2> low{1e9f, 1e9f}, high{-1e9f, -1e9f};
    const auto add = [&](const float* at, float around) {
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], view.middle[k] + at[k] - around);
            high[k] = std::max(high[k], view.middle[k] + at[k] + around);
        }
    };
    for (const auto* corners : {&view.facets, &view.glass}) {
        for (const Corner& corner : *corners) {
            add(corner.position, outline);
        }
    }
    for (const Ball& ball : view.balls) {
        add(ball.center, ball.radius + outline);
    }
    const auto pixel = [](float value, int most) {
        return static_cast<int>(std::floor(std::clamp(value, 0.0f, static_cast<float>(most))));
    };
    const int left = pixel(low[0], scene.width), bottom = pixel(low[1], scene.height);
    return {left, bottom, std::max(0, pixel(high[0] + 1, scene.width) - left),
            std::max(0, pixel(high[1] + 1, scene.height) - bottom)};
}

Scene make_scene(const Figure& figure, const Layout& layout, Context& context) {
    Scene scene;
    scene.width = layout.width;
    scene.height = layout.height;
    std::size_t dropped_triangles = 0, dropped_spheres = 0;
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        context.check_cancelled();
        const Panel& panel = figure.panels[i];
        const Layout::Cell& cell = layout.cells[i];
        const Projection project{layout.camera, cell.middle, layout.scale};
        View view;
        view.middle[0] = static_cast<float>(cell.view.left + cell.view.width / 2);
        view.middle[1] = static_cast<float>(layout.height - (cell.view.top + cell.view.height / 2));
        for (const FigureMesh& item : panel.meshes) {
            if (item.mesh) {
                dropped_triangles += add_mesh(item, project, item.translucent ? view.glass : view.facets);
            }
        }
        CancellationCounter asking(256);
        for (std::size_t k = 0; k < panel.spheres.size(); ++k) {
            asking.check();
            if (drawable(panel.spheres[k])) {
                view.balls.push_back(make_ball(panel.spheres[k], k, project, layout.radii));
            } else {
                ++dropped_spheres;
            }
        }
        scene.depth = std::max(scene.depth, 1.01f * reach(view));
        scene.views.push_back(std::move(view));
    }
    if (dropped_triangles > 0 || dropped_spheres > 0) {
        context.log(Severity::warning,
                    "left out of the picture, because their values are not finite, not positive or out of range: " +
                        std::to_string(dropped_triangles) + " triangles, " + std::to_string(dropped_spheres) +
                        " spheres");
    }
    return scene;
}

} // namespace foam::snapshot
