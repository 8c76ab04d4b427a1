// The program on files of other formats, without a recipe.
#include "cli/program.hpp"
#include "exported.hpp"

#include <foam/runtime/contract.hpp>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

class CliAssimp : public Cli {
protected:
    CliAssimp() { export_scene(*scene_of(sample::bracket()), "3ds", path() / "part.3ds"); }
};

TEST_F(CliAssimp, SpherizesAndCertifiesWithoutARecipe) {
    const Outcome spheres = foam("spherize part.3ds -n 8 -o part.csv");
    EXPECT_EQ(spheres.code, 0) << spheres.err;
    EXPECT_THAT(spheres.err, HasSubstr("foam: part.3ds: 200 x 100 x 150 mm, 20 triangles\n"));
    EXPECT_THAT(spheres.err + spheres.out, HasSubstr("Proved: "));
    EXPECT_EQ(foam("certify part.3ds part.csv").code, 0);
    const Outcome inches = foam("spherize part.3ds -n 2 --unit in -o inches.csv");
    EXPECT_THAT(inches.err, HasSubstr("foam: part.3ds: 5.08 x 2.54 x 3.81 mm, 20 triangles\n"));
}

TEST_F(CliAssimp, ADamagedFileIsAnErrorOfThatFile) {
    write("part.3ds", contents(path() / "part.3ds").substr(0, 200));
    const Outcome damaged = foam("spherize part.3ds -n 8 -o part.csv");
    EXPECT_NE(damaged.code, 0);
    EXPECT_THAT(damaged.err, ::testing::AllOf(HasSubstr("part.3ds"), HasSubstr("remedy: ")));
    EXPECT_EQ(damaged.err.find("a bug in foam"), std::string::npos) << damaged.err;
    EXPECT_FALSE(std::filesystem::exists(path() / "part.csv"));
}

} // namespace
} // namespace foam::test
