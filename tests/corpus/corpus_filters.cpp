// Every readable mesh of the shared folders through repair.auto → simplify.quadric → smooth.humphrey → spherize.grid,
// with what each step promises checked after it. Prints a line a mesh.
#include "corpus/mesh_files.hpp"
#include "support/shared_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

namespace fs = std::filesystem;

const Registry& registry() {
    static const std::unique_ptr<const Registry> instance = [] {
        auto made = std::make_unique<Registry>();
        made->load_directory(FOAM_TEST_PLUGINS);
        return made;
    }();
    return *instance;
}

/// Keeps the reason that repair.auto gives.
class Listener final : public QuietContext {
public:
    void log(Severity, std::string_view message) override {
        if (message.starts_with("taken: ")) {
            taken = message.substr(7, message.find_first_of(",;") - 7);
        }
    }
    std::string taken;
};

/// Nothing for a file that is no mesh: corpus_meshes knows which those are.
std::optional<Mesh> loaded(const fs::path& file) {
    const RegisteredStage* loader =
        registry().find_for_extension(StageKind::mesh_loader, file.extension().string().substr(1));
    try {
        QuietContext context;
        return registry().make<MeshLoader>(loader->info.name)->load(file, context);
    } catch (const Error&) {
        return std::nullopt;
    }
}

void expect_solid(const Mesh& mesh, const char* after) {
    const Topology defects = topology(mesh);
    EXPECT_TRUE(defects.closed_manifold()) << "after " << after << ": " << describe(defects);
    EXPECT_GT(signed_volume(mesh), 0) << "after " << after;
}

class CorpusFilters : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CorpusFilters);

TEST_P(CorpusFilters, MakeASolidAndItsSpheres) {
    const std::optional<Mesh> raw = loaded(shared_folder() / GetParam());
    if (!raw) {
        GTEST_SKIP() << "no mesh in this file";
    }
    Listener listener;
    Mesh mesh = registry().make<MeshFilter>("repair.auto")->apply(*raw, listener);
    expect_solid(mesh, "repair.auto");
    const bool rebuilt = listener.taken.starts_with("repair.watertight") || listener.taken == "repair.wrap";
    EXPECT_TRUE(!rebuilt || self_intersections(mesh).empty());
    const MeshChange repair = mesh_change(*raw, mesh, 0);
    std::string row = GetParam() + ": " + listener.taken + ": " + describe(repair);

    for (const char* stage : {"simplify.quadric", "smooth.humphrey"}) {
        const Mesh before = mesh;
        mesh = registry().make<MeshFilter>(stage)->apply(before, listener);
        expect_solid(mesh, stage);
        const MeshChange change = mesh_change(before, mesh, 0);
        EXPECT_LT(change.distance(), 0.05 * bounds(before).diagonal()) << stage;
        EXPECT_LT(std::abs(change.volume_change().value_or(1)), 0.05) << stage;
        row += std::string("; ") + stage + ": " + describe(change);
    }

    const auto original = Solid::make(*raw);
    const Shape shape(GetParam(), Solid::make(mesh), original);
    QuietContext context;
    Budget budget;
    budget.max_spheres = 8;
    const SphereTree tree = registry().make<Spherizer>("spherize.grid")->spherize(shape, budget, context);
    const std::vector<Sphere> spheres = grown_to_cover(*original, tree.levels.back().elements.spheres());
    EXPECT_LE(spheres.size(), 8u);
    EXPECT_TRUE(certify(*original, spheres).holds);
    std::printf("%s; %zu spheres\n", row.c_str(), spheres.size());
}

/// Both folders, relative to the shared folder.
std::vector<std::string> files() {
    std::vector<std::string> result;
    for (const char* folder : {"meshes", "robots"}) {
        for (const std::string& file : mesh_files_below(shared_folder() / folder)) {
            if (folder == std::string("meshes") || file.find("visual") == std::string::npos) {
                result.push_back(std::string(folder) + "/" + file);
            }
        }
    }
    return result;
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusFilters, ::testing::ValuesIn(files()),
                         [](const auto& file) { return name_of_case(file.param); });

} // namespace
} // namespace foam
