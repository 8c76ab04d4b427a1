// The same geometry gives the same result, wherever it lies, however large it is, in whatever order its faces and
// vertices come; and the guards of simplification and smoothing hold for all of them. Every filter of the registry.
#include "filters.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/solid.hpp>

#include <numeric>

namespace foam::test {
namespace {

/// Up to which a result may differ: shares of diagonal, area and volume.
struct Tolerance {
    double distance, measure;
};

/// Rebuilt surfaces follow a grid along the axes, greedy simplification its queue: they agree as far as they
/// approximate their input. All others compute with what they are given, up to rounding.
Tolerance tolerance_of(const std::string& filter) {
    return filter == "repair.watertight" || filter == "repair.wrap" || filter.starts_with("simplify.")
               ? Tolerance{0.02, 0.05}
               : Tolerance{1e-6, 1e-6};
}

/// Uniform among rotations: Shoemake, Uniform random rotations, 1992.
Pose random_pose(Random& random, double extent) {
    const double u = random.uniform(), turn = 2 * std::numbers::pi;
    const double a = turn * random.uniform(), b = turn * random.uniform();
    const double x = std::sqrt(1 - u) * std::sin(a), y = std::sqrt(1 - u) * std::cos(a);
    const double z = std::sqrt(u) * std::sin(b), w = std::sqrt(u) * std::cos(b);
    Pose pose;
    pose.rotation = {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                     Vec3{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                     Vec3{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    pose.translation = Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * extent;
    return pose;
}

template <class T> void shuffle(std::vector<T>& values, Random& random) {
    for (std::size_t i = values.size(); i > 1; --i) {
        std::swap(values[i - 1], values[random.below(i)]);
    }
}

/// Vertices and triangles in another order, each triangle from another corner.
Mesh reordered(const Mesh& mesh, Random& random) {
    std::vector<std::uint32_t> place(mesh.vertices.size());
    std::iota(place.begin(), place.end(), 0u);
    shuffle(place, random);
    Mesh result;
    result.vertices.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        result.vertices[place[i]] = mesh.vertices[i];
    }
    for (Triangle t : mesh.triangles) {
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
        result.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    }
    shuffle(result.triangles, random);
    return result;
}

/// Every third triangle once more, some of them from another corner.
Mesh repeated(const Mesh& mesh, Random& random) {
    Mesh result = mesh;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        Triangle t = mesh.triangles[i];
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
        result.triangles.push_back(t);
    }
    return result;
}

/// Half of the triangles facing the other way.
Mesh turned(const Mesh& mesh, Random& random) {
    Mesh result = mesh;
    for (Triangle& t : result.triangles) {
        if (random.below(2) == 0) {
            std::swap(t[0], t[1]);
        }
    }
    return result;
}

/// Fine enough for the filters to work on, without the symmetries that make ties.
std::vector<Named> closed_shapes() {
    return {{"ball", noisy(ball({}, 0.1, 48), 0.0005)},
            {"torus", noisy(torus(0.2, 0.06, 64), 0.001)},
            {"two parts", united(noisy(ball({}, 0.1, 32), 0.001), noisy(torus(0.2, 0.04), 0.001))}};
}

std::vector<Named> open_shapes() {
    return {{"ball with a hole", without(noisy(ball({}, 0.1, 48), 0.0005), 200, 4)},
            {"open box", without(box({}, {0.2, 0.3, 0.4}), 0, 2)},
            {"open cylinder", open_cylinder(0.1, 0.3)}};
}

bool is_repair(const std::string& filter) {
    return filter.starts_with("repair.");
}

class Property : public ::testing::TestWithParam<std::string> {
protected:
    /// What the filter is tried on. A wrap takes a second a shape, and where it enters an opening, how far depends on
    /// how the grid of its first cells lies: few shapes for it, without wide openings.
    static std::vector<Named> shapes() {
        if (GetParam() == "repair.wrap") {
            return {closed_shapes().front(), open_shapes().front()};
        }
        std::vector<Named> all = closed_shapes();
        if (is_repair(GetParam())) {
            const std::vector<Named> open = open_shapes();
            all.insert(all.end(), open.begin(), open.end());
        }
        return all;
    }

    static Mesh result_of(const Mesh& mesh) {
        const bool wraps = GetParam() == "repair.wrap";
        Mesh result = filtered(GetParam(), mesh, wraps ? Settings{{"alpha", 0.1}, {"offset", 0.01}} : Settings{});
        expect_solid(result);
        if (wraps || GetParam() == "repair.watertight") {
            EXPECT_TRUE(self_intersections(result).empty());
        }
        return result;
    }

    static void expect_same(const Mesh& expected, const Mesh& found) {
        const Tolerance tolerance = tolerance_of(GetParam());
        const double volume = signed_volume(expected), area = surface_area(expected);
        EXPECT_NEAR(signed_volume(found) / volume, 1, tolerance.measure);
        EXPECT_NEAR(surface_area(found) / area, 1, tolerance.measure);
        const MeshChange change = mesh_change(expected, found, 1, 1000);
        EXPECT_LT(change.distance(), tolerance.distance * bounds(expected).diagonal());
    }

    Random random{derive_seed(7, GetParam())};
};

TEST_P(Property, RigidMotion) {
    for (const Named& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        const Mesh expected = result_of(shape.mesh);
        for (const double extent : {0.3, 10.0}) {
            const Pose pose = random_pose(random, extent);
            expect_same(expected, transformed(result_of(transformed(shape.mesh, pose)), pose.inverse()));
        }
    }
}

TEST_P(Property, Scale) {
    for (const Named& shape : shapes()) {
        const Mesh expected = result_of(shape.mesh);
        for (const double scale : {1e-6, 1e-3, 1e4}) {
            SCOPED_TRACE(shape.name + " times " + std::to_string(scale));
            expect_same(expected, scaled(result_of(scaled(shape.mesh, scale)), 1 / scale));
        }
    }
}

TEST_P(Property, OrderOfFacesAndVertices) {
    for (const Named& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        expect_same(result_of(shape.mesh), result_of(reordered(shape.mesh, random)));
    }
}

class RepairProperty : public Property {};

TEST_P(RepairProperty, RepeatedAndTurnedFaces) {
    for (const Named& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        const Mesh expected = result_of(shape.mesh);
        expect_same(expected, result_of(repeated(shape.mesh, random)));
        expect_same(expected, result_of(turned(shape.mesh, random)));
        expect_same(expected, result_of(reordered(turned(repeated(shape.mesh, random), random), random)));
    }
}

std::vector<std::string> filters_called(const std::string& begin) {
    std::vector<std::string> names;
    for (const auto& [name, stage] : registry().stages()) {
        if (stage.kind == StageKind::mesh_filter && name.starts_with(begin)) {
            names.push_back(name);
        }
    }
    return names;
}

const auto name_of_case = [](const auto& instance) {
    std::string name = instance.param;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
};

INSTANTIATE_TEST_SUITE_P(Registered, Property, ::testing::ValuesIn(filters_called("")), name_of_case);
INSTANTIATE_TEST_SUITE_P(Registered, RepairProperty, ::testing::ValuesIn(filters_called("repair.")), name_of_case);

/// Shapes at random places, sizes and orders.
std::vector<Mesh> variants(std::uint64_t seed) {
    Random random(seed);
    std::vector<Mesh> result;
    for (const Named& shape : closed_shapes()) {
        for (const double scale : {1e-6, 1.0, 1e4}) {
            const Mesh moved = transformed(reordered(shape.mesh, random), random_pose(random, 0.3));
            result.push_back(scaled(moved, scale));
        }
    }
    return result;
}

TEST(Guards, SimplificationStaysWithinItsDistanceAndTurnsNoFaceOver) {
    for (const Mesh& mesh : variants(1)) {
        const double size = bounds(mesh).diagonal();
        for (const double bound : {0.001 * size, 0.005 * size}) {
            const Mesh result =
                filtered("simplify.quadric", mesh,
                         {{"max_distance", bound}, {"ratio", 0.0001}, {"min_triangles", std::int64_t{4}}});
            expect_solid(result);
            EXPECT_LT(result.triangles.size(), mesh.triangles.size());
            EXPECT_TRUE(lies_within(bound * (1 + 1e-9), mesh, result));
            EXPECT_TRUE(lies_within(bound * (1 + 1e-9), result, mesh));
            EXPECT_TRUE(self_intersections(result).empty()) << "a face that is turned over lies in its neighbours";
        }
    }
}

/// The largest distance between the same vertex of two meshes.
double largest_move(const Mesh& a, const Mesh& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        largest = std::max(largest, distance(a.vertices[i], b.vertices[i]));
    }
    return largest;
}

TEST(Guards, SmoothingTurnsNoFaceOverAndStaysNear) {
    Random random(2);
    for (const Mesh& mesh : variants(2)) {
        Mesh rough = mesh; // vertices move by more than the edges are long
        const double amplitude = 0.02 * bounds(mesh).diagonal();
        for (Vec3& p : rough.vertices) {
            p += Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * amplitude;
        }
        for (const char* name : {"smooth.laplacian", "smooth.taubin", "smooth.humphrey"}) {
            SCOPED_TRACE(name);
            const Mesh step = filtered(name, rough, {{"iterations", std::int64_t{1}}});
            EXPECT_EQ(step.triangles, rough.triangles);
            std::size_t over = 0;
            for (const auto& [a, b, c] : rough.triangles) {
                const auto normal = [&, a = a, b = b, c = c](const std::vector<Vec3>& p) {
                    return cross(p[b] - p[a], p[c] - p[a]);
                };
                over += !(dot(normal(rough.vertices), normal(step.vertices)) > 0);
            }
            EXPECT_EQ(over, 0u);
            const Mesh result = filtered(name, rough, {{"iterations", std::int64_t{20}}, {"max_move", 0.02}});
            EXPECT_LE(largest_move(rough, result), 0.02 * bounds(rough).diagonal() * (1 + 1e-9));
            const double volume = signed_volume(rough);
            EXPECT_NEAR(signed_volume(result), volume, 0.0201 * std::abs(volume));
        }
    }
}

} // namespace
} // namespace foam::test
