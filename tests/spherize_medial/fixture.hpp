// Meshes of known shape, and the stage under test.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/stage.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <numbers>
#include <string>
#include <vector>

namespace foam::test {

/// Keeps what a stage says.
class ListeningContext final : public QuietContext {
public:
    using QuietContext::QuietContext;
    void log(Severity, std::string_view message) override {
        const std::lock_guard lock(mutex_);
        messages.emplace_back(message);
    }
    std::vector<std::string> messages;

private:
    std::mutex mutex_;
};

using sample::box;

/// A closed surface of revolution about z through the profile (radius, height) from bottom to top; both ends on the
/// axis.
inline Mesh revolved(const std::vector<std::pair<double, double>>& profile, std::uint32_t sides = 24) {
    Mesh mesh;
    const auto rings = static_cast<std::uint32_t>(profile.size()) - 2;
    mesh.vertices.push_back({0, 0, profile.front().second});
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            mesh.vertices.push_back(
                {profile[ring].first * std::cos(angle), profile[ring].first * std::sin(angle), profile[ring].second});
        }
    }
    mesh.vertices.push_back({0, 0, profile.back().second});
    const auto at = [&](std::uint32_t ring, std::uint32_t i) { return 1 + ring * sides + i % sides; };
    const auto top = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
    for (std::uint32_t i = 0; i < sides; ++i) {
        mesh.triangles.push_back({0, at(0, i + 1), at(0, i)});
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            mesh.triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i)});
            mesh.triangles.push_back({at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)});
        }
        mesh.triangles.push_back({at(rings - 1, i), at(rings - 1, i + 1), top});
    }
    return mesh;
}

/// Length is that of the straight part.
inline Mesh capsule(double radius, double length, std::uint32_t sides = 24) {
    std::vector<std::pair<double, double>> profile;
    constexpr int steps = 8;
    for (int end = -1; end <= 1; end += 2) {
        for (int i = 0; i <= steps; ++i) {
            const double angle = std::numbers::pi / 2 * (end < 0 ? i - steps : i) / steps;
            profile.emplace_back(radius * std::cos(angle), end * length / 2 + radius * std::sin(angle));
        }
    }
    return revolved(profile, sides);
}

inline Mesh ball(double radius, std::uint32_t sides = 32) {
    return capsule(radius, 1e-3 * radius, sides);
}

inline Mesh torus(double major, double minor, std::uint32_t around = 32, std::uint32_t along = 16) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < along; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / along;
            const double r = major + minor * std::cos(v);
            mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
            const std::uint32_t a = i * along + j, b = (i + 1) % around * along + j,
                                c = (i + 1) % around * along + (j + 1) % along, d = i * along + (j + 1) % along;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    }
    return mesh;
}

/// An L of two bars with a square section.
inline Mesh bracket(double leg, double width) {
    const std::vector<std::pair<double, double>> outline{{0, 0},         {leg, 0},     {leg, width},
                                                         {width, width}, {width, leg}, {0, leg}};
    Mesh mesh;
    for (const double z : {0.0, width}) {
        for (const auto& [x, y] : outline) {
            mesh.vertices.push_back({x, y, z});
        }
    }
    for (const Triangle t : {Triangle{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
        mesh.triangles.push_back({t[0], t[2], t[1]});
        mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.triangles.push_back({i, j, j + 6});
        mesh.triangles.push_back({i, j + 6, i + 6});
    }
    return mesh;
}

/// Like a robot's link: a tapering lofted body.
inline Mesh loft() {
    return revolved(
        {{0, -0.2}, {0.09, -0.2}, {0.09, -0.1}, {0.05, -0.05}, {0.05, 0.1}, {0.07, 0.15}, {0.07, 0.2}, {0, 0.2}});
}

inline Shape shape_of(Mesh mesh, const std::string& name = "part") {
    const auto solid = Solid::make(std::move(mesh));
    return Shape(name, solid, solid);
}

inline Budget at_most(std::size_t count) {
    Budget budget;
    budget.max_spheres = count;
    return budget;
}

using Settings = std::map<std::string, ParameterValue>;

inline std::unique_ptr<Spherizer> stage(const std::string& name, const Settings& parameters = {}) {
    static const std::unique_ptr<Registry> registry = [] {
        auto made = std::make_unique<Registry>();
        const PluginRecord& record = made->load(FOAM_TEST_PLUGINS "/spherize_medial.so");
        if (!record.loaded()) {
            throw std::runtime_error(record.rejection);
        }
        return made;
    }();
    return registry->make<Spherizer>(name, parameters);
}

inline std::unique_ptr<Spherizer> medial(const Settings& parameters = {}) {
    return stage("spherize.medial", parameters);
}

inline std::vector<Sphere> spheres(const Mesh& mesh, std::size_t count,
                                   const std::map<std::string, ParameterValue>& parameters = {}) {
    QuietContext context;
    return medial(parameters)->spherize(shape_of(mesh), at_most(count), context).finest();
}

/// vol(U \ S) / vol(S) of the spheres as the runtime uses them: grown to cover. For solids whose inside U holds.
inline double excess(const Mesh& mesh, const std::vector<Sphere>& spheres) {
    const auto solid = Solid::make(mesh);
    return union_volume(grown_to_cover(*solid, spheres)) / solid->volume() - 1;
}

inline double largest_gap(const Solid& solid, const std::vector<Sphere>& spheres) {
    double gap = 0;
    for (const SurfacePoint& sample : solid.sample_surface(5'000, 17)) {
        double least = std::numeric_limits<double>::infinity();
        for (const Sphere& sphere : spheres) {
            least = std::min(least, distance(sample.point, sphere.center) - sphere.radius);
        }
        gap = std::max(gap, least);
    }
    return gap;
}

} // namespace foam::test
