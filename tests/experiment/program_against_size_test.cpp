// kind: program_against_size.
#include "experiments.hpp"

namespace foam {
namespace {

using ::testing::HasSubstr;
using ProgramAgainstSize = ExperimentTest;

const std::string head = "foam_experiment: 1\nname: a\nkind: program_against_size\n";

TEST_F(ProgramAgainstSize, IsReadWithOneAxis) {
    EXPECT_EQ(findings(head + "mesh: a.stl\nspheres: [1, 2]\ncurves: {normal: {}}\n"), "");
    EXPECT_EQ(
        findings(head + "mesh: a.stl\nspheres: [8]\ntriangles: [10, 20]\ncurves: {fast: {stages.x.effort: fast}}\n"),
        "");
    EXPECT_THAT(findings(head + "mesh: a.stl\nspheres: [1, 2]\ntriangles: [10, 20]\ncurves: {normal: {}}\n"),
                HasSubstr("several numbers of triangles and of spheres"));
}

TEST_F(ProgramAgainstSize, SaysWhatIsMissing) {
    const std::string all = findings(head + "spheres: [2, 1]\ncurves: {}\n");
    for (const char* what : {"mesh", "'spheres' expects ascending numbers", "'curves' expects at least one curve"}) {
        EXPECT_THAT(all, HasSubstr(what));
    }
}

} // namespace
} // namespace foam
