// kind: program_against_size.
#include <foam/bench/experiment.hpp>

#include <gtest/gtest.h>

#include <string>

namespace {

using namespace foam;

std::string findings_of(const std::string& text) {
    const Registry registry;
    std::string all;
    for (const Diagnostic& finding :
         parse_experiment("foam_experiment: 1\nname: a\nkind: program_against_size\n" + text, "x.yaml", registry)
             .diagnostics) {
        all += finding.message + "\n";
    }
    return all;
}

TEST(ProgramAgainstSize, IsReadWithOneAxis) {
    EXPECT_EQ(findings_of("mesh: a.stl\nspheres: [1, 2]\ncurves: {normal: {}}\n"), "");
    EXPECT_EQ(findings_of("mesh: a.stl\nspheres: [8]\ntriangles: [10, 20]\ncurves: {fast: {stages.x.effort: fast}}\n"),
              "");
    EXPECT_NE(findings_of("mesh: a.stl\nspheres: [1, 2]\ntriangles: [10, 20]\ncurves: {normal: {}}\n")
                  .find("several numbers of triangles and of spheres"),
              std::string::npos);
}

TEST(ProgramAgainstSize, SaysWhatIsMissing) {
    const std::string all = findings_of("spheres: [2, 1]\ncurves: {}\n");
    for (const char* what : {"mesh", "'spheres' expects ascending numbers", "'curves' expects at least one curve"}) {
        EXPECT_NE(all.find(what), std::string::npos) << what << " in\n" << all;
    }
}

} // namespace
