// Files that end too early or whose bytes are wrong: an error that names the file and the remedy, or a mesh that passes
// the checks; foam itself lives on, within the limits of time and memory.
#include "fixture.hpp"
#include "isolation/ill.hpp"

#include <foam/recipe/recipe.hpp>
#include <foam/runtime/plan.hpp>

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A sound file, and how it is damaged.
struct Victim {
    const char* id;
    const char* ending;
    const char* sample; ///< null: assimp's exporter writes it
};

void PrintTo(const Victim& victim, std::ostream* out) {
    *out << victim.id;
}

constexpr Victim victims[] = {{"3ds", "3ds", nullptr},           {"x", "x", nullptr},
                              {"x3d", "x3d", nullptr},           {"3mf", "3mf", nullptr},
                              {"fbxa", "fbx", nullptr},          {"fbx", "fbx", nullptr},
                              {"assbin", "assbin", nullptr},     {"ac", "ac", "tetrahedron.ac"},
                              {"amf", "amf", "tetrahedron.amf"}, {"ase", "ase", "tetrahedron.ase"}};

class Damaged : public LoadAssimp, public ::testing::WithParamInterface<Victim> {
protected:
    Damaged() {
        registry.load(FOAM_TEST_PLUGINS "/spherize_octree.so");
        options.program = FOAM_TEST_BINARY;
        options.fresh = true;
        const std::string memory = sanitized ? "" : ", memory_limit: 1024"; // sanitizers keep none
        const RecipeResult read = parse_recipe("foam: 1\nmesh: x.3ds\nstages: [spherize.octree]\noutputs: []\n"
                                               "loaders: {load.assimp: {time_limit: 20" +
                                                   memory + "}}\n",
                                               folder.path() / "recipe.yaml", registry);
        EXPECT_TRUE(read.ok());
        recipe = read.recipes.at(0);
    }

    std::string bytes_of_victim() const {
        const Victim& victim = GetParam();
        const auto file = victim.sample
                              ? std::filesystem::path(FOAM_TEST_SOURCE "/plugins/load_assimp/samples") / victim.sample
                              : exported(*scene_of(sample::box({1, 2, 3})), {victim.id, victim.ending});
        std::ostringstream text;
        text << std::ifstream(file, std::ios::binary).rdbuf();
        return text.str();
    }

    /// Why it is refused; empty if it is a mesh.
    std::string outcome_of(const std::string& bytes) {
        const std::string name = std::string("damaged.") + GetParam().ending;
        write(name, bytes);
        recipe.mesh = {name};
        std::string error;
        try {
            error = plan(recipe, registry, options).links.at(0).error;
        } catch (const Error& thrown) {
            error = thrown.what();
        }
        if (!error.empty()) {
            EXPECT_THAT(error, AllOf(HasSubstr(name), HasSubstr("remedy: ")));
        }
        return error;
    }

    Recipe recipe;
    RunOptions options;
};

TEST_P(Damaged, CutOffFilesEndWell) {
    const std::string bytes = bytes_of_victim();
    EXPECT_EQ(outcome_of(bytes), "") << "the whole file";
    constexpr std::size_t cuts = 50;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < cuts; ++i) {
        refused += outcome_of(bytes.substr(0, bytes.size() * i / cuts)).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, cuts / 2);
}

TEST_P(Damaged, FilesWithWrongBytesEndWell) {
    const std::string bytes = bytes_of_victim();
    Random random(20261122);
    for (int i = 0; i < 15; ++i) {
        std::string wrong = bytes;
        for (int flips = 0; flips < 1 + i % 4; ++flips) {
            wrong[random.bits() % wrong.size()] ^= static_cast<char>(1 << random.bits() % 8);
        }
        outcome_of(wrong);
    }
}

INSTANTIATE_TEST_SUITE_P(Format, Damaged, ::testing::ValuesIn(victims),
                         [](const auto& victim) { return std::string("As_") + victim.param.id; });

} // namespace
} // namespace foam::test
