// What is said of plugins that break a promise, in the library and by `foam test-plugin`.
#include "cli/program.hpp"

#include <foam/runtime/contract.hpp>

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// "promise: message" of each finding.
std::vector<std::string> findings(const std::string& plugin, const std::string& stage,
                                  const ContractOptions& options = {}) {
    Registry registry;
    const PluginRecord& record = registry.load(FOAM_TEST_BROKEN "/" + plugin + ".so");
    EXPECT_TRUE(record.loaded()) << record.rejection;
    std::vector<std::string> texts;
    for (const ContractFinding& finding : check_contract(*registry.find(stage), registry, options)) {
        EXPECT_EQ(finding.stage, stage);
        texts.push_back(finding.promise + ": " + finding.message);
    }
    return texts;
}

TEST(Sample, SolidsAreClosedAndOutward) {
    for (const auto& [mesh, volume] : {std::pair{sample::box({0.1, 0.2, 0.3}), 0.1 * 0.2 * 0.3},
                                       {sample::bracket(), 0.1 * (0.2 * 0.05 + 0.05 * 0.1)}}) {
        EXPECT_TRUE(topology(mesh).closed_manifold()) << describe(topology(mesh));
        EXPECT_NEAR(signed_volume(mesh), volume, 1e-12);
    }
    EXPECT_TRUE(topology(sample::torus(0.1, 0.03)).closed_manifold());
    EXPECT_GT(signed_volume(sample::torus(0.1, 0.03)), 0);
}

TEST(Contract, NothingIsSaidOfAGoodStage) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.good"), IsEmpty());
}

TEST(Contract, TooManySpheres) {
    EXPECT_THAT(
        findings("broken_spherizers", "spherize.too_many"),
        ElementsAre("keeps the budget, stands for the solid, is proved after growth: BallPrimitive: budget of 1: 2 "
                    "spheres in the finest level, 1 were allowed; remedy: keep to budget.max_spheres"));
}

TEST(Contract, SpheresThatAreTooSmall) {
    const auto said = findings("broken_spherizers", "spherize.too_small");
    ASSERT_EQ(said.size(), 2u);
    EXPECT_THAT(said[0], HasSubstr("BallPrimitive: budget of 1: level 0 does not stand for the whole solid: "));
    EXPECT_THAT(said[1], StartsWith("works without a budget: BallPrimitive: level 0 does not stand for"));
}

TEST(Contract, SpheresThatAreNotFinite) {
    const auto said = findings("broken_spherizers", "spherize.not_finite");
    ASSERT_GE(said.size(), 2u);
    EXPECT_THAT(said[0], HasSubstr("BallPrimitive: budget of 1: a sphere is not finite (center "));
}

TEST(Contract, NoSpheres) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.empty")[1],
                "works without a budget: BallPrimitive: it gives no sphere at all");
}

TEST(Contract, StateBetweenCalls) {
    const auto said = findings("broken_spherizers", "spherize.counts");
    ASSERT_EQ(said.size(), 2u);
    EXPECT_THAT(said[0], HasSubstr("BallPrimitive: spherize() gives other spheres than search()"));
    EXPECT_EQ(said[1], "gives the same on any number of threads: Bracket: 4 threads give other spheres than 1; remedy: "
                       "results into slots by index, random numbers from context.random()");
}

TEST(Contract, ASearchThatDependsOnTheCallsBefore) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.order"),
                ElementsAre("keeps the budget, stands for the solid, is proved after growth: BallPrimitive: search() "
                            "gives other spheres for 2 when it is asked again, after 20; remedy: let a result depend "
                            "on its budget only"));
}

TEST(Contract, DeafToTheUser) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.never_stops"),
                ElementsAre("stops when asked: it went on after the user had asked to stop; remedy: call "
                            "context.check_cancelled() in its loops"));
}

TEST(Contract, AnExceptionNamesTheSolid) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.throws"),
                ElementsAre("keeps the budget, stands for the solid, is proved after growth: Needle: no such cell",
                            "works without a budget: Needle: no such cell"));
}

TEST(Contract, AnotherShapeThanItSays) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.looks"),
                ElementsAre("looks at the original alone, as it says: another processed mesh gives other spheres; "
                            "remedy: take Shape::original(), or leave StageInfo::original_only out"));
}

TEST(Contract, AnotherObjectiveThanItSays) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.confused"),
                ElementsAre("has least what its objective says: Bracket, 8 spheres: radius is 0.162 with aim: radius, "
                            "but 0.135 with excess; remedy: let StageInfo::objective_parameter name the parameter that "
                            "says what is to be least"));
}

TEST(Contract, Declarations) {
    EXPECT_THAT(findings("broken_spherizers", "spherize.picky"),
                ElementsAre("declares its parameters well: parameter 'size' has no unit; remedy: .unit(\"m\"), or "
                            ".unit(\"1\") for a ratio",
                            "takes every value that it declares: cells: 0 is allowed by the declaration, but the "
                            "constructor throws: no cells; remedy: declare narrower bounds"));
}

TEST(Contract, Filters) {
    EXPECT_THAT(
        findings("broken_others", "smooth.opens"),
        ElementsAre("gives usable meshes, or refuses: FlatSquare: it gives a triangle with vertex 99, there are 4",
                    "keeps a closed box closed: a box comes out with 3 boundary edges"));
}

TEST(Contract, Loaders) {
    EXPECT_THAT(findings("broken_others", "load.gullible"),
                ElementsAre("refuses what is no mesh: it takes missing.any for a mesh"));
}

TEST(Contract, Writers) {
    EXPECT_THAT(
        findings("broken_others", "write.rounds"),
        ElementsAre(HasSubstr("link tool: sphere 0 comes back smaller or elsewhere (radius 0.05 for 0.05, moved by"),
                    "refuses what nobody could read: a radius of nan is not refused; remedy: throw "
                    "Error(output)"));
}

TEST(Contract, ModelReaders) {
    EXPECT_THAT(findings("broken_others", "read.credulous"),
                ElementsAre("recognises nothing in other files: it recognises '' as its format",
                            "refuses what is no sphere model: its message does not name the file: there is nothing"));
}

TEST_F(Cli, TestPluginNamesEveryPromiseAndExitsWithOne) {
    const Outcome outcome = foam("test-plugin '" FOAM_TEST_BROKEN "/broken_others.so'");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("load.gullible: refuses what is no mesh\n"));
    EXPECT_THAT(outcome.out, HasSubstr("broken_others: 12 of 19 promises kept\n"));
    EXPECT_THAT(outcome.err,
                HasSubstr("foam: load.gullible does not keep the promise 'refuses what is no mesh': it takes "
                          "missing.any for a mesh\n"));
}

TEST_F(Cli, TestPluginSetsParameters) {
    const std::string plugin = "test-plugin '" FOAM_TEST_PLUGINS "/read_rows.so' ";
    EXPECT_THAT(foam(plugin).err, HasSubstr("write.gpmp2 needs the frames of the DH links"));
    const Outcome set = foam(plugin + "--set 'write.gpmp2.frames=base 0 0 0 0 0 0 0; tool 1 0 0 0 1 0 0'");
    EXPECT_EQ(set.code, 0) << set.err;
    EXPECT_THAT(foam(plugin + "--set frames=1").err, HasSubstr("--set expects STAGE.PARAMETER=VALUE, got 'frames=1'"));
    EXPECT_THAT(foam(plugin + "--set write.rows.frames=1").err, HasSubstr("the plugin has no stage 'write.rows'"));
    EXPECT_THAT(foam(plugin + "--set write.gpmp2.frame=1").err, HasSubstr("write.gpmp2 has no parameter 'frame'"));
}

TEST_F(Cli, TestPluginRefusesWhatIsNone) {
    write("none.so", "no library at all");
    const Outcome outcome = foam("test-plugin none.so");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("none.so is refused: it is no shared library (it has no ELF header); remedy: "
                                       "build it with foam_add_plugin()\n"));
}

} // namespace
} // namespace foam::test
