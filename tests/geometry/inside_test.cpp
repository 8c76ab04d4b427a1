// What counts as inside: closed, open, inside out, doubled and mixed meshes.
#include "geometry/files.hpp"
#include "geometry/shapes.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

/// Generalised winding number by the plain sum over all triangles.
double plain_winding(const Mesh& mesh, const Vec3& p) {
    double sum = 0;
    for (const auto& [ia, ib, ic] : mesh.triangles) {
        const Vec3 a = mesh.vertices[ia] - p, b = mesh.vertices[ib] - p, c = mesh.vertices[ic] - p;
        const double la = norm(a), lb = norm(b), lc = norm(c);
        sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

void expect_inside_as_winding(const Mesh& mesh, int points, std::uint64_t seed, double unsure = 1e-6) {
    const auto solid = Solid::make(mesh);
    Random random(seed);
    int compared = 0, inside = 0;
    for (int i = 0; i < points; ++i) {
        const Vec3 p = random_point(random, enlarged(solid->bounds(), 0.1 * solid->bounds().diagonal()));
        const double w = plain_winding(mesh, p);
        if (std::abs(w - 0.5) > unsure) {
            EXPECT_EQ(solid->contains(p), w > 0.5) << "winding " << w;
            ++compared;
            inside += w > 0.5;
        }
    }
    EXPECT_GT(compared, points * 9 / 10);
    EXPECT_GT(inside, 0);
}

Mesh without(Mesh mesh, std::size_t begin, std::size_t end) {
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(begin),
                         mesh.triangles.begin() + static_cast<std::ptrdiff_t>(end));
    return mesh;
}

} // namespace

TEST(Inside, ClosedMeshesAgreeWithTheWindingNumber) {
    expect_inside_as_winding(torus(1, 0.3, 17), 500, 1);
    expect_inside_as_winding(soup(ball({}, 1, 7)), 500, 2);
    expect_inside_as_winding(together(box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.5, 0.5}, {2, 2, 2})), 500, 3);
}

TEST(Inside, OpenMeshesAgreeWithTheWindingNumber) {
    const Mesh bowl = without(ball({}, 1, 16), 200, 500);
    const auto solid = Solid::make(bowl);
    EXPECT_FALSE(solid->closed());
    expect_inside_as_winding(bowl, 2000, 4, 2e-3);
    expect_inside_as_winding(without(torus(1, 0.4, 24), 0, 100), 2000, 5, 2e-3);
}

TEST(Inside, LinesAgreeWithContains) {
    Random random(6);
    for (const Mesh& mesh : {torus(1, 0.3, 17), together(ball({}, 1, 9), ball({0.7, 0, 0}, 1, 11)),
                             together(ball({}, 1, 9), flipped(ball({}, 0.5, 9)))}) {
        const auto solid = Solid::make(mesh);
        for (int i = 0; i < 300; ++i) {
            const Vec3 origin = random_point(random, solid->bounds());
            const Vec3 direction = random_direction(random) * random.uniform(0.1, 3);
            const auto intervals = solid->inside_along(origin, direction);
            double last = -std::numeric_limits<double>::infinity();
            for (const auto& [enter, leave] : intervals) {
                EXPECT_LT(last, enter);
                EXPECT_LT(enter, leave);
                EXPECT_TRUE(solid->contains(origin + direction * ((enter + leave) / 2)));
                if (std::isfinite(last)) {
                    EXPECT_FALSE(solid->contains(origin + direction * ((last + enter) / 2)));
                }
                last = leave;
            }
            const bool inside = std::any_of(intervals.begin(), intervals.end(), [](const auto& interval) {
                return interval.enter <= 0 && 0 <= interval.leave;
            });
            EXPECT_EQ(inside, solid->contains(origin));
        }
    }
}

TEST(Inside, LinesThroughOpenMeshesAgreeWithTheWindingNumber) {
    const Mesh lower = without(ball({}, 1, 16), 0, 240), upper = without(ball({}, 1, 16), 240, 480);
    Mesh apart = upper; // a crack all around
    for (Vec3& v : apart.vertices) {
        v += Vec3{0.004, 0.002, 0.003};
    }
    Random random(7);
    for (const Mesh& mesh : {lower, without(torus(1, 0.4, 24), 0, 100), together(lower, apart),
                             together(without(box({0, 0, 0}, {2, 2, 2}), 0, 2), box({3, 0, 0}, {4, 1, 1}))}) {
        const auto solid = Solid::make(mesh);
        ASSERT_FALSE(solid->closed());
        const double diagonal = solid->bounds().diagonal();
        constexpr int lines = 60, points = 300;
        double sum = 0;
        for (int i = 0; i < lines; ++i) {
            const Vec3 origin = random_point(random, solid->bounds()), direction = random_direction(random);
            double found = 0, expected = 0;
            for (const auto& [enter, leave] : solid->inside_along(origin, direction)) {
                found += leave - enter;
            }
            for (int k = 0; k < points; ++k) {
                const double t = (2 * (k + 0.5) / points - 1) * diagonal;
                expected += plain_winding(mesh, origin + t * direction) > 0.5 ? 2 * diagonal / points : 0;
            }
            EXPECT_NEAR(found, expected, 0.04 * diagonal);
            sum += found - expected;
        }
        EXPECT_NEAR(sum / lines, 0, 0.002 * diagonal);
    }
}

TEST(Inside, TrianglesApartHaveNoInside) {
    Mesh mesh;
    Random random(8);
    for (std::uint32_t i = 0; i < 50; ++i) {
        const Vec3 p = random_point(random, {{0, 0, 0}, {1, 1, 1}});
        mesh.vertices.insert(mesh.vertices.end(),
                             {p, p + 0.1 * random_direction(random), p + 0.1 * random_direction(random)});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const auto solid = Solid::make(mesh);
    double length = 0;
    for (int i = 0; i < 300; ++i) {
        for (const auto& [enter, leave] :
             solid->inside_along(random_point(random, solid->bounds()), random_direction(random))) {
            length += leave - enter;
        }
    }
    EXPECT_NEAR(length / 300, 0, 1e-3);
}

TEST(Inside, LinesThroughVerticesOfAGrid) {
    // A mesh whose vertices lie on a grid, and lines along the grid: every line meets vertices and edges.
    const Mesh mesh = soup(together(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})));
    const auto solid = Solid::make(mesh);
    for (int x = -2; x <= 8; ++x) {
        for (int y = -2; y <= 8; ++y) {
            const double px = 0.5 * x, py = 0.5 * y;
            for (const auto& [enter, leave] : solid->inside_along({px, py, 0}, {0, 0, 1})) {
                EXPECT_GE(enter, 0);
                EXPECT_LE(leave, 3);
            }
            for (int z = -2; z <= 8; ++z) {
                const double pz = 0.5 * z;
                const auto in = [&](double low, double high) {
                    return std::min({px, py, pz}) >= low && std::max({px, py, pz}) <= high;
                };
                EXPECT_EQ(solid->contains({px, py, pz}), in(0, 2) || in(1, 3)) << px << ' ' << py << ' ' << pz;
            }
        }
    }
}

TEST(Inside, MeshInsideOut) {
    const auto solid = Solid::make(flipped(ball({1, 0, 0}, 0.5)));
    EXPECT_TRUE(solid->closed());
    EXPECT_TRUE(solid->contains({1, 0, 0}));
    EXPECT_FALSE(solid->contains({0, 0, 0}));
    EXPECT_GT(solid->volume(), 0.5);
    EXPECT_GT(solid->closest({3, 0, 0}).normal.x, 0.9) << "the surface is turned outwards";
}

TEST(Inside, NestedShells) {
    const auto cavity = Solid::make(together(ball({}, 1), flipped(ball({}, 0.5))));
    EXPECT_FALSE(cavity->contains({}));
    EXPECT_TRUE(cavity->contains({0.7, 0, 0}));
    EXPECT_NEAR(cavity->signed_distance({}), 0.5, 0.01);
    const auto turned = Solid::make(flipped(together(ball({}, 1), flipped(ball({}, 0.5)))));
    EXPECT_FALSE(turned->contains({}));
    EXPECT_TRUE(turned->contains({0.7, 0, 0}));
    EXPECT_DOUBLE_EQ(turned->volume(), cavity->volume());
    const auto filled = Solid::make(together(ball({}, 1), ball({}, 0.5)));
    EXPECT_TRUE(filled->contains({}));
    EXPECT_TRUE(filled->contains({0.7, 0, 0}));
}

TEST(Inside, OneOfTwoBodiesInsideOut) {
    const auto solid = Solid::make(together(ball({}, 1), flipped(ball({5, 0, 0}, 0.5))));
    EXPECT_TRUE(solid->closed());
    EXPECT_TRUE(solid->contains({}));
    EXPECT_TRUE(solid->contains({5, 0, 0}));
    EXPECT_FALSE(solid->contains({2.5, 0, 0}));
}

TEST(Inside, SomeFacesFlipped) {
    Mesh mesh = torus(1, 0.3, 24);
    Random random(9);
    for (Triangle& t : mesh.triangles) {
        if (random.uniform() < 0.3) {
            std::swap(t[0], t[1]);
        }
    }
    const auto solid = Solid::make(mesh), clean = Solid::make(torus(1, 0.3, 24));
    EXPECT_TRUE(solid->closed());
    EXPECT_NEAR(solid->volume(), clean->volume(), 1e-12);
    EXPECT_TRUE(solid->contains({1, 0, 0}));
    EXPECT_FALSE(solid->contains({}));
}

TEST(Inside, FacesTwice) {
    const Mesh once = box({0, 0, 0}, {1, 1, 1});
    for (const Mesh& mesh :
         {together(once, once), together(once, flipped(once)), soup(together(flipped(once), once))}) {
        const auto solid = Solid::make(mesh);
        EXPECT_TRUE(solid->closed());
        EXPECT_TRUE(solid->contains({0.5, 0.5, 0.4}));
        EXPECT_FALSE(solid->contains({1.5, 0.5, 0.4}));
        EXPECT_NEAR(solid->volume(), 1, 1e-12);
        EXPECT_EQ(solid->surface().triangles.size(), 24u) << "the surface keeps what the file has";
    }
}

TEST(Inside, DoubleSidedSheetHasNoInside) {
    const Mesh sheet = without(ball({}, 1, 8), 0, 120);
    const auto solid = Solid::make(together(sheet, flipped(sheet)));
    EXPECT_NEAR(solid->volume(), 0, 1e-12);
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        EXPECT_FALSE(solid->contains(random_point(random, solid->bounds())));
    }
    EXPECT_TRUE(solid->contains(sheet.vertices[sheet.triangles[5][0]])) << "but the surface belongs to it";
}

TEST(Inside, FaceBetweenTwoBodies) {
    // Two boxes that share a face which the file holds twice, once for each.
    const auto solid = Solid::make(together(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})));
    EXPECT_TRUE(solid->closed());
    EXPECT_NEAR(solid->volume(), 2, 1e-12);
    EXPECT_TRUE(solid->contains({1, 0.5, 0.5}));
    EXPECT_TRUE(solid->contains({1.2, 0.5, 0.5}));
}

TEST(Inside, FlatMesh) {
    Mesh plane;
    plane.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto solid = Solid::make(plane);
    EXPECT_FALSE(solid->closed());
    EXPECT_EQ(solid->volume(), 0);
    EXPECT_FALSE(solid->contains({0.5, 0.5, 1e-6}));
    EXPECT_TRUE(solid->contains({0.5, 0.5, 0}));
    EXPECT_DOUBLE_EQ(solid->signed_distance({0.5, 0.5, 2}), 2);
}

struct Expected {
    const char* file;
    bool closed;
    double volume, tolerance; // relative
};

void PrintTo(const Expected& value, std::ostream* stream) {
    *stream << value.file;
}

class SharedMesh : public testing::TestWithParam<Expected> {};

TEST_P(SharedMesh, HasTheVolumeItShould) {
    const std::filesystem::path file = shared_meshes() / GetParam().file;
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const auto solid = Solid::make(read_mesh(file));
    EXPECT_EQ(solid->closed(), GetParam().closed);
    EXPECT_NEAR(solid->volume(), GetParam().volume, GetParam().tolerance * GetParam().volume);
    Random random(2);
    for (int i = 0; i < 50; ++i) {
        const Vec3 p = random_point(random, solid->bounds());
        EXPECT_EQ(solid->contains(p), solid->signed_distance(p) <= 0);
        EXPECT_NEAR(distance(p, solid->closest(p).point), std::abs(solid->signed_distance(p)),
                    1e-12 * (norm(p) + solid->bounds().diagonal()));
    }
}

INSTANTIATE_TEST_SUITE_P(Files, SharedMesh,
                         testing::Values(Expected{"real/3holes.off", true, 0.0994653, 1e-4},
                                         Expected{"real/bunny_7k.off", true, 0.000753934, 1e-4},
                                         Expected{"real/spot.obj", true, 0.718259, 1e-2},
                                         Expected{"synthetic/bracket_doublesided.stl", true, 0.00062, 1e-5},
                                         Expected{"synthetic/bracket_duplicate_faces.stl", true, 0.00062, 1e-5},
                                         Expected{"synthetic/capsule_inside_out.stl", true, 0.00207597, 1e-5},
                                         Expected{"synthetic/torus_mixed_winding.obj", true, 0.00188, 0.1},
                                         Expected{"synthetic/nested_shells_cavity.stl", true, 0.00270812, 1e-5},
                                         Expected{"synthetic/nested_shells_same_winding.stl", true, 0.00412, 2e-3},
                                         Expected{"synthetic/nonmanifold_edge.stl", true, 0.002, 1e-5},
                                         Expected{"synthetic/box_zero_area_faces.stl", true, 0.001, 1e-5},
                                         Expected{"synthetic/capsule_two_holes.stl", false, 0.00205, 0.02},
                                         Expected{"synthetic/box_t_junction.stl", false, 0.001, 2e-3},
                                         Expected{"synthetic/unwelded_jitter_1e-7.stl", false, 0.00412, 2e-3},
                                         Expected{"synthetic/tiny_1e-6.stl", true, 2.07597e-21, 1e-4},
                                         Expected{"synthetic/far_from_origin.obj", true, 0.00207597, 1e-4},
                                         Expected{"synthetic/flat_plane.obj", false, 0, 0},
                                         Expected{"real/Cray_right.obj", true, 1.57608e+116, 1e-4}));
