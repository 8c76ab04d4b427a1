// repair.watertight: a closed solid from anything, close to what was given.
#include "filters.hpp"

#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/solid.hpp>

#include <numbers>

namespace foam::test {
namespace {

constexpr double pi = std::numbers::pi;
const Settings rebuild = {{"keep_closed", false}};

/// Largest distance from points of `from` to the surface `to`.
double deviation(const Mesh& from, const Mesh& to) {
    const auto target = Solid::make(to);
    double largest = 0;
    for (const SurfacePoint& p : Solid::make(from)->sample_surface(3000, 1)) {
        largest = std::max(largest, distance(p.point, target->closest(p.point).point));
    }
    return largest;
}

double volume(const Named& shape, const Settings& settings = {}) {
    SCOPED_TRACE(shape.name);
    const Mesh result = filtered("repair.watertight", shape.mesh, settings);
    expect_solid(result);
    return signed_volume(result);
}

const Named& named(const std::vector<Named>& shapes, const std::string& name) {
    return *std::find_if(shapes.begin(), shapes.end(), [&](const Named& s) { return s.name == name; });
}

TEST(Repair, MakesEveryDefectASolid) {
    for (const Named& shape : defective_meshes()) {
        for (const bool keep : {true, false}) {
            SCOPED_TRACE(shape.name);
            const Mesh result = filtered("repair.watertight", shape.mesh, {{"keep_closed", keep}});
            expect_solid(result);
            EXPECT_EQ(topology(result).degenerate_triangles, 0u);
            if (!keep) {
                EXPECT_TRUE(self_intersections(result).empty());
            }
            // The input lies in the result's box, up to a tenth of a cell.
            const Box given = bounds(shape.mesh), made = bounds(result);
            EXPECT_LT(distance(given.low, made.low), 0.1 * given.diagonal());
            EXPECT_LT(distance(given.high, made.high), 0.1 * given.diagonal());
        }
    }
}

TEST(Repair, GivesDefectiveSolidsTheirVolume) {
    const auto shapes = defective_meshes();
    const double ball_volume = signed_volume(ball({}, 0.1));
    EXPECT_NEAR(volume(named(shapes, "open box")), 1, 0.1);
    EXPECT_NEAR(volume(named(shapes, "ball with a hole")), ball_volume, 0.02 * ball_volume);
    EXPECT_DOUBLE_EQ(volume(named(shapes, "inside out")), ball_volume);
    EXPECT_NEAR(volume(named(shapes, "mixed winding")), signed_volume(torus(0.2, 0.06)), 1e-12);
    EXPECT_DOUBLE_EQ(volume(named(shapes, "every face twice")), 1);
    EXPECT_DOUBLE_EQ(volume(named(shapes, "double sided")), 1);
    EXPECT_NEAR(volume(named(shapes, "T junction")), 1, 0.02);
    EXPECT_NEAR(volume(named(shapes, "shared edge")), 2, 0.05);
    EXPECT_DOUBLE_EQ(volume(named(shapes, "shared corner")), 2);
    EXPECT_NEAR(volume(named(shapes, "shared face")), 2, 0.05);
    EXPECT_DOUBLE_EQ(volume(named(shapes, "no area")), 1);
    EXPECT_NEAR(volume(named(shapes, "open cylinder")), pi * 0.01 * 0.3, 0.04 * pi * 0.01 * 0.3);
    EXPECT_NEAR(volume(named(shapes, "tiny and open")), 1e-21 * signed_volume(ball({}, 1)), 1e-21 * 0.1);
}

TEST(Repair, ThinSheetsBecomeThinSolids) {
    const auto shapes = defective_meshes();
    EXPECT_LT(volume(named(shapes, "flat")), 0.01);
    EXPECT_LT(volume(named(shapes, "single triangle")), 0.005);
    EXPECT_LT(volume(named(shapes, "open cylinder"), {{"fill_openings", false}}), 0.1 * pi * 0.01 * 0.3);
}

TEST(Repair, RebuiltMeshesStayNearTheInput) {
    for (const Named& shape : sound_meshes()) {
        if (shape.name == "cavity" || shape.name == "overlapping" || shape.name == "thin plate") {
            continue;
        }
        SCOPED_TRACE(shape.name);
        const Mesh result = filtered("repair.watertight", shape.mesh, rebuild);
        expect_solid(result);
        EXPECT_NEAR(signed_volume(result), signed_volume(shape.mesh), 0.03 * signed_volume(shape.mesh));
        EXPECT_LT(deviation(shape.mesh, result), 0.02 * bounds(shape.mesh).diagonal());
        EXPECT_LT(deviation(result, shape.mesh), 0.02 * bounds(shape.mesh).diagonal());
    }
}

TEST(Repair, MoreLeavesAreNearer) {
    const Mesh mesh = torus(0.2, 0.06, 96);
    double last = 1;
    for (const std::int64_t leaves : {100, 1000, 10'000}) {
        const Mesh result = filtered("repair.watertight", mesh, {{"keep_closed", false}, {"leaves", leaves}});
        const double now = deviation(result, mesh);
        EXPECT_LT(now, 0.7 * last);
        last = now;
    }
}

TEST(Repair, KeepsClosedMeshesAsTheyAre) {
    for (const Named& shape : sound_meshes()) {
        SCOPED_TRACE(shape.name);
        EXPECT_EQ(filtered("repair.watertight", shape.mesh), welded(shape.mesh));
    }
}

TEST(Repair, FillsCavitiesOnlyWhenItRebuilds) {
    const auto shapes = sound_meshes();
    const double ball_volume = signed_volume(ball({}, 0.1));
    EXPECT_NEAR(volume(named(shapes, "cavity"), rebuild), ball_volume, 0.02 * ball_volume);
    EXPECT_LT(volume(named(shapes, "cavity")), 0.9 * ball_volume);
}

TEST(Repair, TurnsNestedShellsTogether) {
    const double outer = signed_volume(ball({}, 0.1)), inner = signed_volume(ball({}, 0.06));
    const auto of = [](const Mesh& a, const Mesh& b) {
        return signed_volume(filtered("repair.watertight", united(a, b)));
    };
    EXPECT_NEAR(of(ball({}, 0.1), reversed(ball({}, 0.06))), outer - inner, 1e-9);          // a cavity
    EXPECT_NEAR(of(reversed(ball({}, 0.1)), ball({}, 0.06)), outer - inner, 1e-9);          // the same inside out
    EXPECT_NEAR(of(ball({}, 0.1), ball({}, 0.06)), outer + inner, 1e-9);                    // a part inside: a union
    EXPECT_NEAR(of(ball({}, 0.1), reversed(ball({0.5, 0, 0}, 0.06))), outer + inner, 1e-9); // beside each other
    EXPECT_NEAR(of(reversed(ball({}, 0.06)), reversed(ball({0.5, 0, 0}, 0.1))), outer + inner, 1e-9);
}

TEST(Repair, SewsSeams) {
    Mesh loose;
    const Mesh mesh = ball({}, 0.1);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double jitter = (i % 3 - 1.0) * 3e-8;
            loose.vertices.push_back(mesh.vertices[mesh.triangles[i][k]] + Vec3{jitter, -jitter, 0});
        }
        loose.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Mesh result = filtered("repair.watertight", loose);
    expect_solid(result);
    EXPECT_EQ(result.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(result.vertices.size(), mesh.vertices.size());
}

TEST(Repair, IsFreeOfScaleAndPlace) {
    const Mesh mesh = without(ball({}, 1), 0, 60);
    const double relative = signed_volume(filtered("repair.watertight", mesh));
    for (const double factor : {1e-9, 1e-3, 1e6, 1e30}) {
        const Mesh result = filtered("repair.watertight", scaled(mesh, factor));
        EXPECT_NEAR(signed_volume(result) / (factor * factor * factor), relative, 1e-6 * relative);
    }
    EXPECT_NEAR(signed_volume(filtered("repair.watertight", scaled(mesh, 1, {1e4, 1e4, -1e4}))), relative,
                1e-3 * relative);
}

TEST(Repair, SaysWhatItDid) {
    Listener open, kept, turned;
    filter("repair.watertight")->apply(without(box({}, {1, 1, 1}), 0, 2), open);
    EXPECT_NE(open.said.find("rebuilt (4 boundary edges)"), std::string::npos) << open.said;
    EXPECT_GE(open.metrics.at("occupied_cells"), 1000);
    EXPECT_TRUE(open.metrics.contains("vertices_untangled"));
    filter("repair.watertight")->apply(box({}, {1, 1, 1}), kept);
    EXPECT_NE(kept.said.find("not rebuilt"), std::string::npos) << kept.said;
    filter("repair.watertight")->apply(reversed(box({}, {1, 1, 1})), turned);
    EXPECT_NE(turned.said.find("turned"), std::string::npos) << turned.said;
}

TEST(Repair, RefusesWhatIsNoSurface) {
    EXPECT_NE(refusal("repair.watertight", {}).find("no triangle with an area"), std::string::npos);
    const Mesh line = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}};
    EXPECT_NE(refusal("repair.watertight", line).find("no triangle with an area"), std::string::npos);
    EXPECT_NE(refusal("repair.watertight", scaled(box({}, {1, 1, 1}), 1e300)).find("too large for its volume"),
              std::string::npos);
}

TEST(Repair, LargestSinglePrecisionMeshFits) {
    const Mesh mesh = without(box({}, {6.8e38, 6.8e38, 6.8e38}), 0, 1);
    EXPECT_NEAR(signed_volume(filtered("repair.watertight", mesh)) / 3.14432e116, 1, 0.1);
}

} // namespace
} // namespace foam::test
