// The same recipe gives the same bytes, whatever the circumstances.
#include "fixture.hpp"

#include <foam/runtime/run.hpp>

#include <clocale>
#include <locale>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using SameBytes = Reproduce;

TEST_F(SameBytes, OnOneAndFourThreads) {
    must("run two.yaml --fresh -j1 --run-dir one");
    must("run two.yaml --fresh -j4 --run-dir four");
    expect_same("one", "four");
}

TEST_F(SameBytes, FromTheCacheWholeOrInPart) {
    must("run two.yaml --fresh --run-dir fresh");
    // A smaller budget asks for some of the same counts: they are in the cache already when two.yaml runs.
    must("run two.yaml --set budget.spheres=5 --run-dir other");
    must("run two.yaml --run-dir partly");
    must("run two.yaml --run-dir cached");
    expect_same("fresh", "partly");
    expect_same("fresh", "cached");
    const auto cached = manifest("cached");
    for (const auto& link : cached["execution"]["links"]) {
        for (const auto& stage : link["stages"]) {
            const std::string name = stage["stage"];
            EXPECT_EQ(stage["cached"],
                      name.starts_with("simplify") || name.starts_with("smooth") || name.starts_with("spherize"))
                << name;
        }
    }
}

TEST_F(SameBytes, FromAnotherWorkingDirectory) {
    must("run two.yaml --fresh --run-dir here");
    ASSERT_EQ(shell("mkdir -p away/deep && cd away/deep && '" FOAM_TEST_BINARY "' run ../../two.yaml --fresh "
                    "--run-dir ../../there")
                  .code,
              0);
    expect_same("here", "there");
}

TEST_F(SameBytes, FromTheResolvedRecipe) {
    must("run two.yaml --fresh --set budget.spheres=7 --run-dir first");
    must("run first/recipe.resolved.yaml --fresh --run-dir second");
    expect_same("first", "second");
}

TEST_F(SameBytes, OfASingleMeshFromTheResolvedRecipe) {
    write("mesh.yaml",
          "foam: 1\nname: mesh\nmesh: bumpy.obj\nstages: [spherize.octree]\nbudget: {spheres: 4}\n"
          "outputs: [write.urdf: {file: mesh.urdf}, write.json: {file: mesh.json}]\ndebug: {meshes: true}\n");
    must("run mesh.yaml --fresh --run-dir first");
    must("run first/recipe.resolved.yaml --fresh --run-dir second");
    expect_same("first", "second");
    EXPECT_THAT(contents(path() / "first/mesh.urdf"), HasSubstr("filename=\"../bumpy.obj\""));
}

TEST_F(SameBytes, UnderAGermanLocaleOfTheEnvironment) {
    must("run two.yaml --fresh --run-dir classic");
    ASSERT_EQ(shell("LC_ALL=de_DE.UTF-8 '" FOAM_TEST_BINARY "' run two.yaml --fresh --run-dir german").code, 0);
    expect_same("classic", "german");
}

/// 1.234,5 - as German has it, whether or not that locale is installed.
class Comma final : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// A program that uses the library under a locale of its own.
class SameBytesInProcess : public Reproduce {
protected:
    void run_here(const std::string& out) const {
        Registry registry;
        registry.load_directory(FOAM_TEST_PLUGINS);
        const RecipeResult read = read_recipe(path() / "two.yaml", registry);
        ASSERT_TRUE(read.ok());
        RunOptions options;
        options.out = path() / out;
        options.fresh = true;
        run(read.recipes.at(0), registry, options);
    }
    void TearDown() override {
        std::locale::global(std::locale::classic());
        std::setlocale(LC_ALL, "C");
    }
};

TEST_F(SameBytesInProcess, UnderStreamsThatWriteACommaForThePoint) {
    run_here("classic");
    std::locale::global(std::locale(std::locale::classic(), new Comma));
    run_here("comma");
    expect_same("classic", "comma");
}

TEST_F(SameBytesInProcess, UnderTheGermanLocale) {
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) {
        GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
    }
    std::setlocale(LC_ALL, "C");
    run_here("classic");
    std::locale::global(std::locale("de_DE.UTF-8"));
    ASSERT_STREQ(std::localeconv()->decimal_point, ",");
    run_here("german");
    expect_same("classic", "german");
}

} // namespace
} // namespace foam::test
