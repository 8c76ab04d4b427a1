// simplify.quadric: fewer triangles, the same solid.
#include "filters.hpp"

#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/solid.hpp>

namespace foam::test {
namespace {

const Settings hard = {{"ratio", 0.2}, {"min_triangles", std::int64_t{4}}};

TEST(Simplify, ReachesTheRatio) {
    for (const Mesh& mesh : {ball({}, 0.1, 64), torus(0.2, 0.06, 96), filtered("repair.watertight", soup(40))}) {
        const Mesh result = filtered("simplify.quadric", mesh, hard);
        expect_solid(result);
        EXPECT_LE(result.triangles.size(), mesh.triangles.size() / 5 + 2);
        EXPECT_GE(result.triangles.size(), mesh.triangles.size() / 5 - 2);
        EXPECT_NEAR(signed_volume(result), signed_volume(mesh), 0.0201 * signed_volume(mesh));
    }
}

TEST(Simplify, StaysNear) {
    const Mesh mesh = torus(0.2, 0.06, 96);
    const Mesh result = filtered("simplify.quadric", mesh, hard);
    const auto before = Solid::make(mesh), after = Solid::make(result);
    for (const SurfacePoint& p : before->sample_surface(2000, 1)) {
        EXPECT_LT(distance(p.point, after->closest(p.point).point), 0.01 * 0.2);
    }
    for (const SurfacePoint& p : after->sample_surface(2000, 1)) {
        const SurfacePoint q = before->closest(p.point);
        EXPECT_LT(distance(p.point, q.point), 0.01 * 0.2);
        EXPECT_GT(dot(p.normal, q.normal), 0) << "a triangle is turned over";
    }
}

TEST(Simplify, FlatFacesCollapseWithoutError) {
    // A box whose faces are grids: two triangles a face are enough.
    const Mesh fine = filtered("repair.watertight", box({}, {1, 1, 1}), {{"keep_closed", false}});
    const Mesh result = filtered("simplify.quadric", fine, {{"target_triangles", std::int64_t{60}}});
    expect_solid(result);
    EXPECT_LE(result.triangles.size(), 60u);
    EXPECT_NEAR(signed_volume(result), signed_volume(fine), 0.01);
}

TEST(Simplify, NeverDestroysASolid) {
    const Settings least = {{"target_triangles", std::int64_t{4}}};
    const Mesh cube = box({}, {1, 1, 1});
    EXPECT_EQ(filtered("simplify.quadric", cube, least), cube);
    const Mesh two = united(ball({}, 0.1), ball({1, 0, 0}, 0.001, 16));
    const Mesh result = filtered("simplify.quadric", two, least);
    expect_solid(result);
    EXPECT_EQ(topology(result).components, 2u);
    EXPECT_NEAR(signed_volume(result), signed_volume(two), 0.0201 * signed_volume(two));
    const Mesh ring = filtered("simplify.quadric", torus(0.2, 0.06),
                               {{"target_triangles", std::int64_t{4}}, {"volume_tolerance", 1.0}});
    expect_solid(ring);
    // Euler's number tells that the hole is still there.
    EXPECT_EQ(ring.vertices.size() * 2, ring.triangles.size());
}

TEST(Simplify, CoarseMeshesStay) {
    const Mesh mesh = torus(0.2, 0.06, 24);
    EXPECT_LT(mesh.triangles.size(), 800u);
    EXPECT_EQ(filtered("simplify.quadric", mesh), mesh);
}

TEST(Simplify, KeepsBoundaries) {
    const Mesh sheet = flat_grid(20);
    const Mesh result = filtered("simplify.quadric", sheet, hard);
    EXPECT_TRUE(topology(result).manifold());
    EXPECT_TRUE(topology(result).oriented());
    EXPECT_LE(result.triangles.size(), 162u);
    EXPECT_NEAR(surface_area(result), 1, 1e-3);
}

TEST(Simplify, SaysWhatToDoWithNonManifolds) {
    for (const Named& shape : defective_meshes()) {
        const Topology defects = topology(welded(shape.mesh));
        if (!defects.manifold() || !defects.oriented()) {
            SCOPED_TRACE(shape.name);
            EXPECT_NE(refusal("simplify.quadric", welded(shape.mesh)).find("put repair.auto before"),
                      std::string::npos);
        }
    }
}

TEST(Simplify, SaysWhenItFallsShort) {
    Listener listener;
    const Mesh result =
        filter("simplify.quadric", {{"target_triangles", std::int64_t{4}}})->apply(ball({}, 1), listener);
    EXPECT_NE(listener.said.find("4 were wanted"), std::string::npos) << listener.said;
    EXPECT_GT(result.triangles.size(), 4u);
}

TEST(Simplify, ProvesABoundOnTheDistance) {
    const Mesh mesh = ball({}, 0.1, 48);
    std::size_t last = mesh.triangles.size();
    for (const double bound : {0.0001, 0.0005, 0.002}) {
        const Mesh result = filtered("simplify.quadric", mesh,
                                     {{"max_distance", bound}, {"ratio", 0.0001}, {"min_triangles", std::int64_t{4}}});
        expect_solid(result);
        EXPECT_LT(result.triangles.size(), last);
        last = result.triangles.size();
        const MeshChange change = mesh_change(mesh, result, 1, 5000);
        EXPECT_LE(change.distance(), bound);
        EXPECT_GT(change.distance(), 0.1 * bound); // not far from what is allowed
    }
}

} // namespace
} // namespace foam::test
