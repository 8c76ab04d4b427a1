// Every file of the mesh corpus: the triangles and volume it must give, or the reason it must be refused with.
#include "fixture.hpp"

#include <set>
#include <thread>

namespace foam::test {
namespace {

struct Expectation {
    const char* file;
    std::size_t triangles; ///< 0: refused
    double volume;         ///< signed, m³
    const char* reason;
};

// Counts and volumes from the corpus' MANIFEST.md (trimesh's readers), COLLADA with its unit applied.
const std::vector<Expectation> expectations{
    {"real/stanford-bunny.obj", 69451, 0.000739384, ""},
    {"real/bunny_7k.off", 6966, 0.000753934, ""},
    {"real/armadillo.obj", 86482, 0.0686187, ""},
    {"real/fandisk.obj", 12946, 20.2434, ""},
    {"real/rocker-arm.obj", 20088, 0.0425136, ""},
    {"real/spot.obj", 5856, 0.718259, ""},
    {"real/suzanne.obj", 968, 2.22756, ""},
    {"real/teapot.obj", 6320, 26.2937, ""},
    {"real/3holes.off", 7200, 0.0994653, ""},
    {"real/featuretype.STL", 3476, 11.6277, ""},
    {"real/1002_tray_bottom.STL", 4520, 347866.0, ""},
    {"real/plate_holes.STL", 1252, 767362.0, ""},
    {"real/cycloidal.ply", 43368, 1.86564, ""},
    {"real/idler_riser.STL", 1572, 1.4878, ""},
    {"real/bunny_nonmanifold.ply", 16301, 0.000735577, ""},
    {"real/chair_model.obj", 12756, 0, ""},
    {"real/soup.stl", 100, -0.109645, ""},
    {"real/multibody.stl", 32, 0.00184842, ""},
    {"real/joined_tetrahedra.obj", 8, 0.866025, ""},
    {"real/polygonfaces.obj", 3, 9259259.2592592593,
     ""}, // a pentagon far from plane: no triangulation is the right one
    {"real/duck.dae", 4212, 1.19553, ""},
    {"real/CesiumMilkTruck.glb", 3624, 19.2489, ""},
    {"real/nested.glb", 36, 0.898779, ""},
    {"real/self_intersectA.obj", 17160, 0.147953, ""},
    {"real/openscad-nonmanifold-crash.obj", 1442, 451.96, ""},
    {"real/Cray_right.obj", 12, 1.57608e+116, ""},
    {"real/Generic_Twin_7081.1.t0_right.obj", 11656, 43004.4, ""},
    {"real/Wuson.stl", 3732, 1.14837, ""},
    {"real/sphereWithHole.stl", 285, 13.4586, ""},
    {"real/Spider_ascii.stl", 1368, 10.0854, ""},
    {"real/truck.obj", 4770, -0.055582, ""},
    {"real/malformed.obj", 0, 0, "malformed.obj:23: the face refers to vertex 12, but the file has 8"},
    {"real/invalid.off", 0, 0, "invalid.off:7: a corner of the face is missing"},
    {"real/IndexOutOfRange.gltf", 0, 0, "IndexOutOfRange.bin, which cannot be read"},
    {"real/BoxWithInfinites.glb", 0, 0, "is not finite: ("},
    {"real/cube_emptyTags.dae", 12, 1e6, ""},
    {"synthetic/nonmanifold_edge.stl", 24, 0.002, ""},
    {"synthetic/nonmanifold_vertex.obj", 24, 0.002, ""},
    {"synthetic/capsule_two_holes.stl", 963, 0.00194628, ""},
    {"synthetic/capsule_inside_out.stl", 1024, -0.00207597, ""},
    {"synthetic/torus_mixed_winding.obj", 1024, 0.000732058, ""},
    {"synthetic/bracket_duplicate_faces.stl", 40, 0.00124, ""},
    {"synthetic/bracket_doublesided.stl", 40, 0, ""},
    {"synthetic/box_zero_area_faces.stl", 16, 0.001, ""},
    {"synthetic/flat_plane.obj", 800, 0, ""},
    {"synthetic/single_triangle.stl", 1, 0, ""},
    {"synthetic/disconnected_27_boxes.stl", 324, 0.003375, ""},
    {"synthetic/nested_shells_cavity.stl", 1920, 0.00270812, ""},
    {"synthetic/nested_shells_same_winding.stl", 1920, 0.00553577, ""},
    {"synthetic/overlapping_parts.obj", 2060, 0.00492108, ""},
    {"synthetic/open_cylinder.ply", 576, 0.00104421, ""},
    {"synthetic/thin_plate.stl", 12, 3e-05, ""},
    {"synthetic/box_t_junction.stl", 15, 0.001, ""},
    {"synthetic/moebius_strip.obj", 128, 0.000788905, ""},
    {"synthetic/unwelded_jitter_1e-7.stl", 960, 0.00412194, ""},
    {"synthetic/empty.stl", 0, 0, "the file is empty"},
    {"synthetic/empty.obj", 0, 0, "the file is empty"},
    {"synthetic/header_only.stl", 0, 0, "there are no triangles in it"},
    {"synthetic/truncated_binary.stl", 0, 0, "the binary STL promises "},
    {"synthetic/count_too_large.stl", 0, 0,
     "the binary STL promises 4000000000 triangles (200000000084 bytes), but the file has 684 bytes; remedy: "},
    {"synthetic/binary_header_solid.stl", 1024, 0.00207597, ""},
    {"synthetic/ascii.stl", 20, 0.00062, ""},
    {"synthetic/ascii_upper_crlf.stl", 12, 0.001, ""},
    {"synthetic/ascii_multi_solid.stl", 1048, 0.00372012, ""},
    {"synthetic/nan_vertex.stl", 0, 0, "is not finite: (nan, "},
    {"synthetic/inf_vertex.obj", 0, 0, "inf_vertex.obj:9: a coordinate of the vertex is not finite: (inf, 0, 0)"},
    {"synthetic/star_ngon_concave.obj", 36, 0.000587785, ""},
    {"synthetic/negative_indices.obj", 12, 0.001, ""},
    {"synthetic/missing_mtl.obj", 1024, 0.00207597, ""},
    {"synthetic/index_out_of_range.obj", 0, 0,
     "index_out_of_range.obj:21: the face refers to vertex 99, but the file has 8"},
    {"synthetic/big_endian.ply", 1024, 0.00172012, ""},
    {"synthetic/quads_extra_props.ply", 12, 0.001, ""},
    {"synthetic/points_only.ply", 0, 0, "there are no triangles in it, only "},
    {"synthetic/inch_x_up.dae", 20, 0.00062, ""},
    {"synthetic/mm_y_up_instances.dae", 36, 0.004, ""},
    {"synthetic/embedded.gltf", 2048, 0.00344023, ""},
    {"synthetic/node_scale.glb", 1024, 0.00207597, ""},
    {"synthetic/far_from_origin.obj", 1024, 0.00207597, ""},
    {"synthetic/tiny_1e-6.stl", 1024, 2.07597e-21, ""},
    {"synthetic/garbage.stl", 0, 0, "garbage.stl:3: expected 'outer', got 'xxx"},
};

class Corpus : public LoadMesh {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(shared_folder() / "meshes")) {
            GTEST_SKIP() << "no folder " << shared_folder() / "meshes";
        }
        LoadMesh::SetUp();
    }
};

/// About the mean of all corners, as the figures of the manifest: for open meshes the point matters.
double volume_about_mean(const Mesh& mesh) {
    Vec3 mean;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            mean += mesh.vertices[corner] / static_cast<double>(3 * mesh.triangles.size());
        }
    }
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += dot(mesh.vertices[a] - mean, cross(mesh.vertices[b] - mean, mesh.vertices[c] - mean));
    }
    return sum / 6;
}

void check(const Expectation& expected, const Mesh& mesh) {
    EXPECT_EQ(mesh.triangles.size(), expected.triangles);
    const double scale = std::max(std::abs(expected.volume), std::pow(bounds(mesh).diagonal(), 3) * 1e-9);
    EXPECT_NEAR(volume_about_mean(mesh), expected.volume, 1e-5 * scale);
    for (const Vec3& vertex : mesh.vertices) {
        ASSERT_TRUE(is_finite(vertex));
    }
    std::set<std::uint32_t> used;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            ASSERT_LT(corner, mesh.vertices.size());
            used.insert(corner);
        }
    }
    EXPECT_EQ(used.size(), mesh.vertices.size()) << "unused vertices";
}

TEST_F(Corpus, EveryFileGivesItsMeshOrItsReason) {
    for (const Expectation& expected : expectations) {
        SCOPED_TRACE(expected.file);
        const auto file = shared_folder() / "meshes" / expected.file;
        if (expected.triangles == 0) {
            const std::string message = error_of(file);
            EXPECT_NE(message, "") << "it was read";
            EXPECT_NE(message.find(expected.reason), message.npos) << message;
            continue;
        }
        try {
            check(expected, load(file));
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

TEST_F(Corpus, NoFileIsForgotten) {
    std::set<std::string> listed, there;
    for (const Expectation& expected : expectations) {
        listed.insert(expected.file);
    }
    for (const char* part : {"real", "synthetic"}) {
        for (const auto& entry : std::filesystem::directory_iterator(shared_folder() / "meshes" / part)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".py" && ending != ".md" && ending != ".json") {
                there.insert(std::string(part) + "/" + entry.path().filename().string());
            }
        }
    }
    EXPECT_EQ(listed, there);
}

TEST_F(Corpus, ManyThreadsReadTheSame) {
    constexpr std::size_t threads = 8;
    std::vector<std::vector<Mesh>> results(threads);
    std::vector<std::thread> pool;
    for (std::size_t t = 0; t < threads; ++t) {
        pool.emplace_back([&, t] {
            QuietContext quiet;
            for (const char* name :
                 {"real/duck.dae", "real/CesiumMilkTruck.glb", "synthetic/embedded.gltf", "real/featuretype.STL",
                  "synthetic/mm_y_up_instances.dae", "real/3holes.off", "real/spot.obj"}) {
                results[t].push_back(loader->load(shared_folder() / "meshes" / name, quiet));
            }
        });
    }
    for (std::thread& thread : pool) {
        thread.join();
    }
    for (const auto& result : results) {
        EXPECT_TRUE(result == results[0]);
    }
}

TEST_F(Corpus, RobotMeshesLoad) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_folder() / "robots")) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".stl" || ending == ".STL" || ending == ".dae" || ending == ".obj") {
            EXPECT_EQ(error_of(entry.path()), "");
            ++count;
        }
    }
    EXPECT_GT(count, 10u);
}

} // namespace
} // namespace foam::test
