// Meshes of others through the filters of the paper: repair, simplify, smooth.
#include "filters.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>

namespace foam::test {
namespace {

std::filesystem::path shared_folder() {
    const char* given = std::getenv("FOAM_SHARED");
    return given ? given : FOAM_TEST_SHARED;
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Nothing for a file that is no mesh: that is another test's matter.
std::optional<Mesh> loaded(const std::filesystem::path& file) {
    try {
        QuietContext context;
        return registry().make<MeshLoader>("load.mesh")->load(file, context);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// What went wrong on the way; empty if nothing did.
std::string walk(const Mesh& mesh, const Settings& repair, double& volume) {
    Mesh result = mesh;
    const auto step = [&](const std::string& name, const Settings& settings) -> std::string {
        result = filtered(name, result, settings);
        const Topology defects = topology(result);
        if (!is_usable(result) || !defects.closed_manifold() || !(signed_volume(result) > 0)) {
            return name + ": " + describe(defects);
        }
        if (name == "repair.watertight" && settings.contains("keep_closed") && !self_intersections(result).empty()) {
            return name + ": triangles pass through each other";
        }
        return {};
    };
    try {
        std::string trouble = step("repair.watertight", repair);
        volume = signed_volume(result);
        for (const char* name : {"simplify.quadric", "smooth.humphrey"}) {
            trouble = trouble.empty() ? step(name, {}) : trouble;
        }
        return trouble;
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST(Corpus, EveryMeshBecomesASolid) {
    const std::filesystem::path folder = shared_folder() / "meshes";
    if (!std::filesystem::exists(folder / "stats.json")) {
        GTEST_SKIP() << "no meshes in " << folder;
    }
    const nlohmann::json stats = nlohmann::json::parse(std::ifstream(folder / "stats.json"));
    const std::vector<std::filesystem::path> files = files_below(folder);
    std::vector<std::string> troubles(files.size());
    std::vector<double> given(files.size()), made(files.size());
    std::vector<char> tried(files.size(), 0);
    parallel_for(files.size(), [&](std::size_t i) {
        if (const std::optional<Mesh> mesh = loaded(files[i])) {
            tried[i] = 1;
            given[i] = signed_volume(*mesh);
            troubles[i] = walk(*mesh, {}, made[i]);
        }
    });
    EXPECT_GT(std::count(tried.begin(), tried.end(), 1), 50);
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string name = std::filesystem::relative(files[i], folder).generic_string();
        SCOPED_TRACE(name);
        EXPECT_EQ(troubles[i], "");
        const bool sound = stats.contains(name) && stats[name].value("watertight", false) &&
                           stats[name].value("oriented", false) && stats[name].value("zero_area", 0) == 0;
        if (tried[i] && sound) {
            EXPECT_NEAR(made[i], std::abs(given[i]), 1e-3 * std::abs(given[i]));
        }
    }
}

TEST(Corpus, OpenMeshesGetTheirVolume) {
    const std::filesystem::path folder = shared_folder() / "meshes";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "no meshes in " << folder;
    }
    struct Expectation {
        const char* file;
        double volume, tolerance; // m³, relative
    };
    // The bunny's volume is that of its closed version (bunny_7k.off); the others' shapes are known.
    for (const Expectation& expected : {Expectation{"real/stanford-bunny.obj", 0.000754, 0.05},
                                        {"real/bunny_nonmanifold.ply", 0.000754, 0.05},
                                        {"synthetic/capsule_two_holes.stl", 0.00207597, 0.03},
                                        {"synthetic/box_t_junction.stl", 0.001, 0.03},
                                        {"synthetic/nonmanifold_edge.stl", 0.002, 0.03},
                                        {"synthetic/bracket_doublesided.stl", 0.00062, 1e-6},
                                        {"synthetic/torus_mixed_winding.obj", 0.00172012, 1e-3}}) {
        SCOPED_TRACE(expected.file);
        const std::optional<Mesh> mesh = loaded(folder / expected.file);
        ASSERT_TRUE(mesh);
        EXPECT_NEAR(signed_volume(filtered("repair.watertight", *mesh)), expected.volume,
                    expected.tolerance * expected.volume);
    }
}

TEST(Corpus, RebuiltPandaLinksAreNotInflated) {
    const std::filesystem::path folder =
        shared_folder() / "robots/panda/moveit_resources_panda_description/meshes/collision";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "no meshes in " << folder;
    }
    for (const std::filesystem::path& file : files_below(folder)) {
        SCOPED_TRACE(file.filename());
        const std::optional<Mesh> mesh = loaded(file);
        ASSERT_TRUE(mesh);
        const double before = signed_volume(*mesh);
        double after = 0;
        EXPECT_EQ(walk(*mesh, {{"keep_closed", false}}, after), "");
        EXPECT_NEAR(after, before, 0.05 * before);
    }
}

} // namespace
} // namespace foam::test
