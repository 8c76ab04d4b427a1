// The figures of measure() against a second estimate by another method that shares no code with it: plain Monte Carlo
// with generalised winding numbers summed over all triangles, primitives by their equations, distances to every
// triangle by brute force. They agree within three standard errors.
#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>

namespace foam::test {
namespace {

/// Uniform numbers in [0, 1) by the standard's generator, which is the same in every library.
class Uniform {
public:
    explicit Uniform(unsigned seed) : generator_(seed) {}
    double operator()() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
    double operator()(double low, double high) { return low + (high - low) * (*this)(); }
    Vec3 in(const Vec3& low, const Vec3& high) {
        return {(*this)(low.x, high.x), (*this)(low.y, high.y), (*this)(low.z, high.z)};
    }
    Vec3 direction() { // Archimedes: the height over the axis is uniform
        const double z = (*this)(-1, 1), angle = (*this)(0, 2 * std::numbers::pi), across = std::sqrt(1 - z * z);
        return {across * std::cos(angle), across * std::sin(angle), z};
    }

private:
    std::mt19937_64 generator_;
};

struct Estimate {
    double value = 0, error = 0;
};

Estimate mean_of(const std::vector<double>& values, double scale = 1) {
    double sum = 0, squares = 0;
    for (const double v : values) {
        sum += v;
        squares += v * v;
    }
    const double n = static_cast<double>(values.size()), mean = sum / n;
    return {scale * mean, scale * std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
}

/// A geometry as the second estimator sees it.
struct Geometry {
    std::vector<std::array<Vec3, 3>> triangles;
    std::function<bool(const Vec3&)> inside;
    std::function<double(const Vec3&)> distance; ///< from outside
    std::shared_ptr<const Solid> solid;          ///< what measure() gets
};

/// Signed solid angle of a triangle seen from p, over 4π, by the sum of its three dihedral angles (spherical excess):
/// not the formula that core uses.
double winding_share(const std::array<Vec3, 3>& t, const Vec3& p) {
    std::array<Vec3, 3> u;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 d = t[k] - p;
        u[k] = d / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    }
    double excess = -std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = u[k], &b = u[(k + 1) % 3], &c = u[(k + 2) % 3];
        const Vec3 n = cross(a, b), m = cross(a, c);
        const Vec3 side = cross(n, m);
        excess += std::atan2(std::sqrt(dot(side, side)), dot(n, m));
    }
    return (dot(u[0], cross(u[1], u[2])) < 0 ? -excess : excess) / (4 * std::numbers::pi);
}

double winding(const std::vector<std::array<Vec3, 3>>& triangles, const Vec3& p) {
    double sum = 0;
    for (const auto& t : triangles) {
        sum += winding_share(t, p);
    }
    return sum;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double length2 = dot(d, d), t = length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0;
    const Vec3 e = p - (a + t * d);
    return std::sqrt(dot(e, e));
}

double distance_to_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double n2 = dot(n, n);
    bool above = n2 > 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = t[k], &b = t[(k + 1) % 3];
        above = above && dot(cross(b - a, p - a), n) >= 0;
        nearest = std::min(nearest, distance_to_segment(p, a, b));
    }
    return above ? std::abs(dot(p - t[0], n)) / std::sqrt(n2) : nearest;
}

Geometry of_mesh(const Mesh& mesh) {
    Geometry geometry;
    for (const Triangle& t : mesh.triangles) {
        geometry.triangles.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    }
    const auto triangles = std::make_shared<std::vector<std::array<Vec3, 3>>>(geometry.triangles);
    geometry.inside = [triangles](const Vec3& p) { return winding(*triangles, p) > 0.5; };
    geometry.distance = [triangles](const Vec3& p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& t : *triangles) {
            nearest = std::min(nearest, distance_to_triangle(p, t));
        }
        return nearest;
    };
    geometry.solid = Solid::make(mesh);
    return geometry;
}

/// A link of the embedded arm, read here.
Mesh embedded(const std::string& name) {
    std::ifstream file(std::filesystem::path(FOAM_TEST_SOURCE) / "configs/robots/panda/meshes" / name);
    Mesh mesh;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        words.imbue(std::locale::classic());
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Vec3 v;
            words >> v.x >> v.y >> v.z;
            mesh.vertices.push_back(v);
        } else if (kind == "f") {
            std::vector<std::uint32_t> corners;
            for (std::string corner; words >> corner;) {
                corners.push_back(static_cast<std::uint32_t>(std::stoul(corner)) - 1);
            }
            for (std::size_t k = 2; k < corners.size(); ++k) {
                mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
            }
        }
    }
    return mesh;
}

/// A box and a cylinder that overlap, the cylinder turned into the x-axis.
Geometry primitives() {
    const Element box = Element::box({0.2, 0.3, 0.1});
    const Element cylinder = Element::cylinder(0.06, 0.4);
    const Pose pose = Pose::from_xyz_rpy({0.1, 0, 0}, {0, std::numbers::pi / 2, 0});
    Geometry geometry;
    geometry.solid = Solid::make({{nullptr, box, Pose{}}, {nullptr, cylinder, pose}});
    const auto box_distance = [](const Vec3& p) {
        const double x = std::max(std::abs(p.x) - 0.1, 0.0), y = std::max(std::abs(p.y) - 0.15, 0.0),
                     z = std::max(std::abs(p.z) - 0.05, 0.0);
        return std::sqrt(x * x + y * y + z * z);
    };
    const auto cylinder_distance = [](const Vec3& p) {
        const double across = std::max(std::sqrt(p.y * p.y + p.z * p.z) - 0.06, 0.0),
                     along = std::max(std::abs(p.x - 0.1) - 0.2, 0.0);
        return std::sqrt(across * across + along * along);
    };
    geometry.inside = [=](const Vec3& p) { return box_distance(p) == 0 || cylinder_distance(p) == 0; };
    geometry.distance = [=](const Vec3& p) { return std::min(box_distance(p), cylinder_distance(p)); };
    return geometry;
}

/// Spheres about points of the box, half of them where the geometry is.
std::vector<Sphere> some_spheres(const Geometry& geometry, unsigned seed) {
    Uniform uniform(seed);
    const Box& box = geometry.solid->bounds();
    const Vec3 size = box.size();
    const double smallest = std::min({size.x, size.y, size.z});
    std::vector<Sphere> spheres;
    while (spheres.size() < 8) {
        const Vec3 center = uniform.in(box.low, box.high);
        if (spheres.size() % 2 == 1 || geometry.inside(center)) {
            spheres.push_back({center, smallest * uniform(0.2, 0.7)});
        }
    }
    return spheres;
}

bool in_any(const std::vector<Sphere>& spheres, const Vec3& p) {
    return std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& s) {
        const Vec3 d = p - s.center;
        return d.x * d.x + d.y * d.y + d.z * d.z <= s.radius * s.radius;
    });
}

void expect_same(const Estimate& ours, const Estimate& theirs, const char* what) {
    EXPECT_LE(std::abs(ours.value - theirs.value), 3 * std::hypot(ours.error, theirs.error))
        << what << ": " << ours.value << " ± " << ours.error << " and " << theirs.value << " ± " << theirs.error;
    EXPECT_GT(theirs.error, 0) << what << ": the second estimate says nothing";
}

void check_volumes(const Geometry& geometry, const std::vector<Sphere>& spheres, const Measures& m) {
    Vec3 low = geometry.solid->bounds().low, high = geometry.solid->bounds().high;
    for (const Sphere& s : spheres) {
        low = {std::min(low.x, s.center.x - s.radius), std::min(low.y, s.center.y - s.radius),
               std::min(low.z, s.center.z - s.radius)};
        high = {std::max(high.x, s.center.x + s.radius), std::max(high.y, s.center.y + s.radius),
                std::max(high.z, s.center.z + s.radius)};
    }
    Uniform uniform(11);
    std::vector<double> excess, missing;
    for (int k = 0; k < 10'000; ++k) {
        const Vec3 p = uniform.in(low, high);
        const bool in_spheres = in_any(spheres, p), inside = geometry.inside(p);
        excess.push_back(in_spheres && !inside);
        missing.push_back(inside && !in_spheres);
    }
    const double volume = (high.x - low.x) * (high.y - low.y) * (high.z - low.z);
    expect_same({m.excess_volume, m.excess_volume_error}, mean_of(excess, volume), "excess");
    expect_same({m.missing_volume, m.missing_volume_error}, mean_of(missing, volume), "missing");
}

void check_surface(const Geometry& geometry, const std::vector<Sphere>& spheres, const Measures& m) {
    std::vector<double> sums;
    double area = 0;
    for (const auto& t : geometry.triangles) {
        const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
        sums.push_back(area += std::sqrt(dot(n, n)) / 2);
    }
    EXPECT_NEAR(m.area, area, 1e-9 * area);
    Uniform uniform(12);
    std::vector<double> covered;
    double gap = 0;
    for (int k = 0; k < 20'000; ++k) {
        const auto at = std::upper_bound(sums.begin(), sums.end(), uniform(0, area)) - sums.begin();
        const auto& t = geometry.triangles[std::min(static_cast<std::size_t>(at), sums.size() - 1)];
        const double root = std::sqrt(uniform()), v = uniform();
        const Vec3 p = (1 - root) * t[0] + root * (1 - v) * t[1] + root * v * t[2];
        covered.push_back(in_any(spheres, p));
        double nearest = std::numeric_limits<double>::infinity();
        for (const Sphere& s : spheres) {
            const Vec3 d = p - s.center;
            nearest = std::min(nearest, std::sqrt(dot(d, d)) - s.radius);
        }
        gap = std::max(gap, nearest);
    }
    expect_same({m.covered, std::sqrt(m.covered * (1 - m.covered) / 100'000)}, mean_of(covered), "covered");
    EXPECT_GE(m.gap, gap) << "a bound from above";
    EXPECT_LE(m.gap, gap + 4 * std::sqrt(area / 20'000)) << "as near as the samples are to each other";
}

void check_protrusion(const Geometry& geometry, const std::vector<Sphere>& spheres, const Measures& m) {
    double area = 0;
    for (const Sphere& s : spheres) {
        area += 4 * std::numbers::pi * s.radius * s.radius;
    }
    Uniform uniform(13);
    std::vector<double> exposed, distances;
    double farthest = 0;
    for (int k = 0; k < 5'000; ++k) {
        double pick = uniform(0, area);
        std::size_t i = 0;
        while (i + 1 < spheres.size() && pick >= 4 * std::numbers::pi * spheres[i].radius * spheres[i].radius) {
            pick -= 4 * std::numbers::pi * spheres[i].radius * spheres[i].radius;
            ++i;
        }
        const Vec3 p = spheres[i].center + spheres[i].radius * uniform.direction();
        std::vector<Sphere> others = spheres;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const bool free = !in_any(others, p) && !geometry.inside(p);
        exposed.push_back(free);
        if (free) {
            distances.push_back(geometry.distance(p));
            farthest = std::max(farthest, distances.back());
        }
    }
    // The lattice of 1000 directions a sphere is no sample; its error is below that of the other estimate.
    expect_same({m.exposed_area, 0}, mean_of(exposed, area), "exposed area");
    expect_same({m.protrusion_mean, 0}, mean_of(distances), "mean protrusion");
    EXPECT_GE(m.protrusion_max, farthest * 0.999);
    EXPECT_LE(m.protrusion_max, farthest * 1.1);
}

void check(const Geometry& geometry, unsigned seed) {
    const std::vector<Sphere> spheres = some_spheres(geometry, seed);
    const Measures m = measure(*geometry.solid, spheres);
    check_volumes(geometry, spheres, m);
    if (!geometry.triangles.empty()) {
        check_surface(geometry, spheres, m);
    }
    check_protrusion(geometry, spheres, m);
}

TEST(IndependentEstimate, BodiesThatOverlap) {
    Mesh mesh = sample::box({0.2, 0.1, 0.05});
    append(mesh, sample::box({0.05, 0.1, 0.2}, {-0.06, 0.01, 0.05}));
    check(of_mesh(mesh), 1);
}

TEST(IndependentEstimate, Torus) {
    check(of_mesh(sample::torus(0.3, 0.1)), 2);
}

TEST(IndependentEstimate, OpenMesh) {
    Mesh mesh = sample::torus(0.3, 0.1);
    mesh.triangles.resize(mesh.triangles.size() * 9 / 10);
    check(of_mesh(mesh), 3);
}

TEST(IndependentEstimate, HandOfTheEmbeddedArm) {
    check(of_mesh(embedded("hand.obj")), 4);
}

TEST(IndependentEstimate, LinkOfTheEmbeddedArm) {
    check(of_mesh(embedded("link5.obj")), 5);
}

TEST(IndependentEstimate, PrimitivesThatOverlap) {
    check(primitives(), 6);
}

} // namespace
} // namespace foam::test
