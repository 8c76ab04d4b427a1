// Tiny experiments, run as `foam bench` does.
#include "support/temporary_folder.hpp"

#include <foam/error.hpp>
#include <foam/host/experiment.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace foam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class Running : public testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"FOAM_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "FOAM_SHARED"}) {
            ::unsetenv(name);
        }
        registry.load_directory(FOAM_TEST_PLUGINS);
    }

    fs::path path() const { return folder.path(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path() / name, std::ios::binary) << text;
    }
    std::string contents(const fs::path& name) const {
        std::ifstream stream(path() / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    ExperimentResult run(const std::string& text, ExperimentOptions options = {}) {
        const ExperimentReading read = parse_experiment(text, path() / "x.yaml", registry);
        EXPECT_TRUE(read.ok()) << (read.diagnostics.empty() ? "" : read.diagnostics.front().text());
        options.out = path() / "out";
        options.tell = [this](const std::string& line) { told += line + "\n"; };
        return run_experiment(*read.experiment, registry, options);
    }
    /// The CSV without its column of times.
    static std::string without(const std::string& csv, std::size_t column) {
        std::string result;
        std::istringstream lines(csv);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream cells(line);
            std::size_t i = 0;
            for (std::string cell; std::getline(cells, cell, ',');) {
                result += i++ == column ? "" : cell + ",";
            }
            result += "\n";
        }
        return result;
    }

    TemporaryFolder folder;
    Registry registry;
    std::string told;
};

const std::string meshes = FOAM_TEST_SOURCE "/configs/robots/panda/meshes/";
const std::string time_experiment = "foam_experiment: 1\nname: x\ntitle: A title\nkind: time_against_triangles\n"
                                    "mesh: [not_there.stl, " +
                                    meshes +
                                    "finger.stl]\ntriangles: [100, 200, 400]\nrepeats: 2\nspheres: 3\n"
                                    "figures:\n  fast: [load.mesh, repair.soup]\n"
                                    "  slow:\n    - [repair.soup, spherize.grid]\n";

TEST_F(Running, TimeAgainstTriangles) {
    const ExperimentResult result = run(time_experiment);
    EXPECT_EQ(without(result.csv, 4), "figure,curve,triangles_wanted,triangles,repeats,remark,\n"
                                      "fast,load.mesh,100,100,2,\nfast,load.mesh,200,200,2,\n"
                                      "fast,load.mesh,400,400,2,\nfast,repair.soup,100,100,2,\n"
                                      "fast,repair.soup,200,200,2,\nfast,repair.soup,400,400,2,\n"
                                      "slow,repair.soup + spherize.grid,100,100,2,\n"
                                      "slow,repair.soup + spherize.grid,200,200,2,\n"
                                      "slow,repair.soup + spherize.grid,400,400,2,\n");
    EXPECT_THAT(result.files, UnorderedElementsAre("results.csv", "results.md", "fast.svg", "slow.svg"));
    EXPECT_EQ(contents("out/results.csv"), result.csv);
    EXPECT_EQ(contents("out/results.md"), result.markdown);
    EXPECT_THAT(contents("out/slow.svg"), HasSubstr("repair.soup + spherize.grid, n^"));
    for (const char* part : {"# A title\n", "![fast](fast.svg)", "at most 3 spheres", "| processor |", "| compiler |",
                             "| experiment | x.yaml, digest ", "| CPU s | 100 | 200 | 400 | growth |"}) {
        EXPECT_THAT(result.markdown, HasSubstr(part));
    }
    EXPECT_EQ(without(run(time_experiment).csv, 4), without(result.csv, 4)); // replaces its own folder
    EXPECT_THAT(run(time_experiment + "prepare: {repair.soup: {largest_hole: 3}}\n").markdown,
                HasSubstr("finger.stl, then repair.soup (largest_hole: 3); "));
}

TEST_F(Running, ATimeLimitEndsACurve) {
    std::string text = time_experiment;
    text.replace(text.find("repeats: 2"), 10, "time_limit: 0.001");
    const ExperimentResult result = run(text);
    EXPECT_THAT(result.csv, HasSubstr("slow,repair.soup + spherize.grid,200,200,,0,left out\n"));
    EXPECT_THAT(result.markdown, HasSubstr("| left out | left out | – |"));
}

TEST_F(Running, ReferenceCurves) {
    const std::string reference = "references: [{label: Other, file: other.csv, where: {step: b}, x: n, y: s}]\n";
    EXPECT_THAT(run(time_experiment + reference).markdown,
                HasSubstr("Left out, its file is not here: Other (other.csv)."));
    write("other.csv", "n,step,s\n100,a,7\n100,b,1\n400,b,16\n200,b,4\n");
    EXPECT_THAT(run(time_experiment + reference).markdown, HasSubstr("Other: 3 published times, growth n^2.00."));
    EXPECT_THAT(contents("out/slow.svg"), HasSubstr("Other, n^2.00"));
    write("other.csv", "n,step,z\n100,b,1\n");
    try {
        run(time_experiment + reference);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  (path() / "other.csv").string() + ": there is no column 's'; did you mean 'n'?");
    }
}

const std::string quality_experiment =
    "foam_experiment: 1\nname: x\nkind: quality_against_spheres\nrobots: {pair: [no.urdf, pair.urdf], none: no.urdf}\n"
    "filters: repair.soup\nmethods: [spherize.grid, spherize.octree]\nspheres: [1, 4]\n";

TEST_F(Running, QualityAgainstSpheres) {
    write("pair.urdf", "<robot name='pair'>"
                       "<link name='a'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
                       "<link name='b'><collision><geometry><mesh filename='" +
                           meshes +
                           "finger.stl'/></geometry></collision></link>"
                           "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>");
    const ExperimentResult result = run(quality_experiment);
    EXPECT_THAT(result.files,
                UnorderedElementsAre("results.csv", "results.md", "excess.svg", "protrusion.svg", "cpu.svg"));
    EXPECT_THAT(result.csv, HasSubstr("\npair,spherize.grid,1,2,"));
    EXPECT_THAT(result.csv, HasSubstr("\npair,spherize.octree,4,"));
    EXPECT_THAT(result.markdown, HasSubstr("Of the 4 models 4 are certified, the largest gap is 0.00 m."));
    EXPECT_THAT(result.markdown, HasSubstr("Left out, as no candidate is here: none."));
    EXPECT_THAT(result.markdown, HasSubstr("Before every method: repair.soup."));
    EXPECT_THAT(told, HasSubstr("warning: x: none is left out: "));
    // A unit cube in its circumscribed ball is most of the volume: excess = √3 π / 2 − 1.
    EXPECT_THAT(result.csv, HasSubstr("spherize.octree,1,2,1.7"));
    EXPECT_EQ(without(run(quality_experiment).csv, 11), without(result.csv, 11));
}

TEST_F(Running, NoRobotIsThere) {
    EXPECT_THROW(run(quality_experiment), Error);
    EXPECT_FALSE(fs::exists(path() / "out"));
}

TEST_F(Running, CancellationLeavesNothing) {
    std::atomic<bool> cancel{true};
    ExperimentOptions options;
    options.cancel = &cancel;
    try {
        run(time_experiment, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
        EXPECT_STREQ(error.what(), "cancelled; nothing was written");
    }
    EXPECT_TRUE(fs::is_empty(path()));
}

TEST_F(Running, ForeignFoldersAreLeftAlone) {
    fs::create_directory(path() / "out");
    write("out/letter.txt", "dear");
    try {
        run(time_experiment);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("no results.csv in it"));
    }
    EXPECT_EQ(contents("out/letter.txt"), "dear");
}

} // namespace
} // namespace foam
