// smooth.laplacian, smooth.taubin and smooth.humphrey.
#include "filters.hpp"

namespace foam::test {
namespace {

const Settings unguarded = {{"iterations", std::int64_t{10}}, {"max_move", 1000.0}, {"volume_tolerance", 1000.0}};

/// Standard deviation of the vertices' distances from the origin: shrinking of a ball does not count, bumps do.
double roughness(const Mesh& mesh) {
    double sum = 0, squares = 0;
    for (const Vec3& p : mesh.vertices) {
        sum += norm(p);
        squares += squared_norm(p);
    }
    const auto count = static_cast<double>(mesh.vertices.size());
    return std::sqrt(squares / count - sum / count * (sum / count));
}

TEST(Smooth, TakesNoiseAway) {
    const Mesh bumpy = noisy(ball({}, 0.1), 0.002);
    for (const char* name : {"smooth.laplacian", "smooth.taubin", "smooth.humphrey"}) {
        const Mesh result = filtered(name, bumpy, {{"max_move", 1.0}, {"volume_tolerance", 1.0}});
        EXPECT_LT(roughness(result), 0.7 * roughness(bumpy)) << name;
        EXPECT_EQ(result.triangles, bumpy.triangles);
    }
}

TEST(Smooth, TaubinKeepsTheVolume) {
    const Mesh mesh = ball({}, 1);
    const double before = signed_volume(mesh);
    EXPECT_NEAR(signed_volume(filtered("smooth.taubin", mesh, unguarded)), before, 0.02 * before);
}

TEST(Smooth, TurnsNoTriangleOver) {
    // A spike between close neighbours: the mean of its ring lies beyond other triangles.
    const Mesh spiky = noisy(ball({}, 0.1, 12), 0.04);
    for (const char* name : {"smooth.laplacian", "smooth.taubin", "smooth.humphrey"}) {
        SCOPED_TRACE(name);
        Settings once = unguarded;
        once["iterations"] = std::int64_t{1};
        const Mesh result = filtered(name, spiky, once);
        std::size_t over = 0;
        for (const auto& [a, b, c] : spiky.triangles) {
            const auto normal = [&, a = a, b = b, c = c](const std::vector<Vec3>& p) {
                return cross(p[b] - p[a], p[c] - p[a]);
            };
            over += !(dot(normal(spiky.vertices), normal(result.vertices)) > 0);
        }
        EXPECT_EQ(over, 0u);
        EXPECT_NE(result, spiky);
    }
}

TEST(Smooth, HumphreyShrinksLessThanLaplacian) {
    const Mesh mesh = ball({}, 1);
    const double before = signed_volume(mesh);
    const double laplacian = signed_volume(filtered("smooth.laplacian", mesh, unguarded));
    const double humphrey = signed_volume(filtered("smooth.humphrey", mesh, unguarded));
    EXPECT_LT(laplacian, 0.95 * before);
    EXPECT_LT(std::abs(humphrey - before), 0.2 * std::abs(laplacian - before));
}

TEST(Smooth, OneStepByHand) {
    // A pyramid over a square: the tip's neighbours are the square's corners.
    const Mesh pyramid = {{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    Settings once = unguarded;
    once["iterations"] = std::int64_t{1};
    EXPECT_NEAR(filtered("smooth.laplacian", pyramid, once).vertices[4].z, 0.5, 1e-15);
    // HC: p = 0, b = 0 - 1 at the tip. At a corner p.z = 1/3 = b.z. Back by 0.5 (-1) + 0.5 (1/3) = -1/3.
    EXPECT_NEAR(filtered("smooth.humphrey", pyramid, once).vertices[4].z, 1.0 / 3, 1e-15);
}

TEST(Smooth, CotangentWeightsLeaveFlatGridsAlone) {
    // In a plane the cotangent mean reproduces a vertex, however the triangles are shaped; the umbrella moves it.
    Mesh fan = {{{0.3, 0.1, 0}, {1, 0, 0}, {0.5, 1, 0}, {-0.5, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {}};
    for (std::uint32_t k = 0; k < 5; ++k) {
        fan.triangles.push_back({0, 1 + k, 1 + (k + 1) % 5});
    }
    Settings once = unguarded;
    once["iterations"] = std::int64_t{1};
    const Vec3 umbrella = filtered("smooth.laplacian", fan, once).vertices[0];
    once["weights"] = std::string("cotangent");
    const Vec3 cotangent = filtered("smooth.laplacian", fan, once).vertices[0];
    EXPECT_LT(distance(cotangent, fan.vertices[0]), 1e-12);
    EXPECT_GT(distance(umbrella, fan.vertices[0]), 0.05);
}

TEST(Smooth, GuardsHold) {
    const Mesh plate = box({}, {0.3, 0.2, 0.0005});
    for (const char* name : {"smooth.laplacian", "smooth.humphrey"}) {
        Listener listener;
        const Mesh result = filter(name)->apply(plate, listener);
        expect_solid(result);
        EXPECT_NEAR(signed_volume(result), signed_volume(plate), 0.0201 * signed_volume(plate));
        EXPECT_NE(listener.said.find("too coarse"), std::string::npos) << listener.said;
        const Mesh held = filtered(name, ball({}, 1), {{"iterations", std::int64_t{100}}, {"volume_tolerance", 1.0}});
        for (std::size_t i = 0; i < held.vertices.size(); ++i) {
            EXPECT_LE(distance(held.vertices[i], ball({}, 1).vertices[i]),
                      0.01 * bounds(ball({}, 1)).diagonal() + 1e-12);
        }
    }
}

TEST(Smooth, OddVerticesAreNoTrouble) {
    Mesh mesh = ball({}, 1);
    mesh.vertices.push_back({5, 5, 5});  // in no triangle
    mesh.triangles.push_back({0, 0, 1}); // a repeated corner
    mesh.triangles.push_back({3, 3, 3});
    mesh.vertices.push_back(mesh.vertices[7]); // a triangle of no area
    mesh.triangles.push_back({7, 8, static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
    for (const char* weights : {"uniform", "cotangent"}) {
        Settings settings = unguarded;
        settings["weights"] = std::string(weights);
        const Mesh result = filtered("smooth.laplacian", mesh, settings);
        EXPECT_TRUE(is_usable(result));
        EXPECT_EQ(result.vertices[mesh.vertices.size() - 2], (Vec3{5, 5, 5}));
    }
    EXPECT_TRUE(is_usable(filtered("smooth.humphrey", mesh, unguarded)));
}

TEST(Smooth, NoIterationsChangeNothing) {
    const Mesh mesh = noisy(torus(0.2, 0.06), 0.004);
    for (const char* name : {"smooth.laplacian", "smooth.humphrey"}) {
        EXPECT_EQ(filtered(name, mesh, {{"iterations", std::int64_t{0}}}), mesh);
    }
}

} // namespace
} // namespace foam::test
