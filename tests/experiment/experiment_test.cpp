// Tiny experiments, run as `foam bench` does.
#include "bench/src/queries/engine.hpp"
#include "bench/src/table.hpp"
#include "experiments.hpp"

#include <foam/base/error.hpp>

#include <iterator>

namespace foam {
namespace {

namespace fs = std::filesystem;
using experiment::parse_csv;
using experiment::Table;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class Running : public ExperimentTest {
protected:
    std::string contents(const fs::path& name) const {
        std::ifstream stream(path() / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    ExperimentResult run(const std::string& text, ExperimentOptions options = {}) {
        options.out = path() / "out";
        options.tell = [this](const std::string& line) { told += line + "\n"; };
        return ExperimentTest::run(text, options);
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
    EXPECT_THAT(result.files,
                UnorderedElementsAre("results.csv", "measured_on.csv", "results.md", "fast.svg", "slow.svg"));
    EXPECT_EQ(contents("out/results.csv"), result.csv);
    EXPECT_EQ(contents("out/results.md"), result.markdown);
    const Table measured_on = parse_csv(contents("out/measured_on.csv"), "measured_on.csv");
    ASSERT_EQ(measured_on.rows.size(), 7u);
    EXPECT_EQ(measured_on.rows.front().front(), "processor");
    for (const auto& row : measured_on.rows) {
        EXPECT_THAT(result.markdown, HasSubstr("| " + row[0] + " | " + row[1] + " |\n"));
    }
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
    EXPECT_THAT(result.files, UnorderedElementsAre("results.csv", "measured_on.csv", "results.md", "excess.svg",
                                                   "protrusion.svg", "cpu.svg"));
    EXPECT_THAT(result.csv, HasSubstr("\npair,spherize.grid,1,2,"));
    EXPECT_THAT(result.csv, HasSubstr("\npair,spherize.octree,4,"));
    EXPECT_THAT(result.markdown, HasSubstr("Of the 4 models 4 are certified, the largest gap is 0.00 m."));
    EXPECT_THAT(result.markdown, HasSubstr("Left out, as no candidate is here: none."));
    EXPECT_THAT(result.markdown, HasSubstr("Before every method: repair.soup."));
    EXPECT_THAT(told, HasSubstr("warning: x: none is skipped: "));
    // A unit cube in its circumscribed ball is most of the volume: excess = √3 π / 2 − 1.
    EXPECT_THAT(result.csv, HasSubstr("spherize.octree,1,2,1.7"));
    EXPECT_EQ(without(run(quality_experiment).csv, 11), without(result.csv, 11));
}

const std::string queries_experiment =
    "foam_experiment: 1\nname: x\nkind: collision_queries\nrobots:\n"
    "  arm: {urdf: [no.urdf, arm.urdf], spheres: 6}\n  other: {urdf: arm.urdf, spheres: spheres.urdf}\n"
    "  none: {urdf: no.urdf, spheres: 1}\n"
    "method: [repair.soup, spherize.octree]\nqueries: 20\ndistances: 5\nenvironments: 4\nobstacles: 3\n";

class Queries : public Running {
protected:
    void SetUp() override {
        Running::SetUp();
        ::setenv("XDG_CACHE_HOME", (path() / "cache").c_str(), 1);
        write("arm.urdf", arm("<mesh filename='" + meshes + "finger.stl'/>", "<box size='0.1 0.1 0.3'/>"));
        write("spheres.urdf", arm("<sphere radius='0.1'/>", "<sphere radius='0.2'/>"));
    }
    /// A base, and an arm on two joints.
    static std::string arm(const std::string& tip, const std::string& base) {
        const auto link = [](const std::string& name, const std::string& shape) {
            return "<link name='" + name + "'><collision><geometry>" + shape + "</geometry></collision></link>";
        };
        const auto joint = [](const std::string& parent, const std::string& child, const std::string& axis) {
            return "<joint name='to_" + child + "' type='continuous'><parent link='" + parent + "'/><child link='" +
                   child + "'/><origin xyz='0.4 0 0.2'/><axis xyz='" + axis + "'/></joint>";
        };
        return "<robot name='arm'>" + link("base", base) + link("upper", base) + link("tip", tip) +
               joint("base", "upper", "0 0 1") + joint("upper", "tip", "0 1 0") + "</robot>";
    }
    static bool have(const char* engine) {
        const auto all = engine_names();
        return std::filesystem::exists(engine_program(
            *std::find_if(all.begin(), all.end(), [&](const EngineName& e) { return engine == std::string(e.name); })));
    }
    static std::string cell(const Table& table, std::size_t row, const std::string& column) {
        const auto it = std::find(table.columns.begin(), table.columns.end(), column);
        return table.rows.at(row).at(static_cast<std::size_t>(it - table.columns.begin()));
    }
};

TEST_F(Queries, TablesAndFiles) {
    const ExperimentResult result = run(queries_experiment);
    EXPECT_THAT(result.files, UnorderedElementsAre("results.csv", "measured_on.csv", "results.md"));
    EXPECT_THAT(result.csv,
                HasSubstr("robot,engine,version,model,shapes,queries,aborted,move_ms,collision_ms,collision_ms_error,"
                          "collision_ms_difference,collision_ms_difference_error,distances,distance_ms,"
                          "distance_ms_error,distance_ms_difference,distance_ms_difference_error,mean_distance_m,"
                          "collides,collides_alone,hits_obstacle,hits_itself,remark\n"));
    EXPECT_THAT(
        result.markdown,
        HasSubstr(
            "| robot | FCL: Δ collision, ms | FCL: Δ distance, ms | FCL: Δ validity, % "
            "| FCL, pair by pair: Δ collision, ms | FCL, pair by pair: Δ distance, ms "
            "| FCL, pair by pair: Δ validity, % | Bullet: Δ collision, ms | Bullet: Δ distance, ms "
            "| Bullet: Δ validity, % | MuJoCo: Δ collision, ms | MuJoCo: Δ distance, ms | MuJoCo: Δ validity, % |"));
    EXPECT_THAT(result.markdown, HasSubstr("| robot | shapes | spheres | queries | collision, ms | by spheres, ms "
                                           "| distances | distance, ms | by spheres, ms | aborted "
                                           "| aborted by spheres |"));
    EXPECT_THAT(result.markdown, HasSubstr("Left out, as no candidate is here: none."));
    EXPECT_THAT(result.markdown, HasSubstr("arm is arm.urdf: 3 links, 6 spheres, "));
    EXPECT_THAT(result.markdown, HasSubstr("other is arm.urdf: 3 links, 3 spheres, "));
    EXPECT_THAT(told, HasSubstr("warning: x: none is skipped: "));
    const Table table = parse_csv(result.csv, "results.csv");
    ASSERT_EQ(table.rows.size(), 16u); // 2 robots, 4 engines, 2 models
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const bool here = have(cell(table, row, "engine").c_str());
        EXPECT_EQ(cell(table, row, "queries"), here ? "20" : "0");
        EXPECT_EQ(cell(table, row, "distances"), here ? "5" : "0");
        EXPECT_EQ(cell(table, row, "remark").empty(), here);
    }
}

TEST_F(Queries, ElementChecks) {
    const std::string text =
        "foam_experiment: 1\nname: x\nkind: element_checks\nrobots: {arm: arm.urdf, none: no.urdf}\n"
        "methods: [spherize.octree, spherize.grid]\nelements: [1, 2]\nposes: 5\npairs: 3\n"
        "repeats: 2\n";
    const ExperimentResult result = run(text);
    EXPECT_THAT(result.files, UnorderedElementsAre("results.csv", "measured_on.csv", "results.md"));
    EXPECT_THAT(result.csv, HasSubstr("robot,method,elements_per_link,elements,pairs,mean_cost,engine,version,"
                                      "near_pair_ns,near_pair_ratio,robot_us,robot_ratio,near_pairs_in_contact,"
                                      "poses_in_contact,remark\n"));
    EXPECT_THAT(result.markdown, HasSubstr("| method | cost by default | FCL | FCL, pair by pair | Bullet | MuJoCo |"));
    EXPECT_THAT(result.markdown, HasSubstr("Left out, as no candidate is here: none."));
    EXPECT_THAT(told, HasSubstr("warning: x: none is skipped: "));
    const Table table = parse_csv(result.csv, "results.csv");
    ASSERT_EQ(table.rows.size(), 16u); // 2 counts, 2 methods, 4 engines
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const bool here = have(cell(table, row, "engine").c_str());
        EXPECT_EQ(cell(table, row, "near_pair_ns").empty(), !here);
        EXPECT_EQ(cell(table, row, "robot_us").empty(), !here);
        EXPECT_EQ(cell(table, row, "remark").empty(), here);
        EXPECT_EQ(cell(table, row, "mean_cost"), "1"); // spheres
        if (here) {
            EXPECT_EQ(cell(table, row, "near_pairs_in_contact"), "0");
        }
        if (here && cell(table, row, "method") == "spherize.octree") {
            EXPECT_EQ(cell(table, row, "robot_ratio"), "1");
        }
    }
    // One sphere a link: base and tip alone are no neighbours.
    EXPECT_EQ(cell(table, 0, "elements"), "3");
    EXPECT_EQ(cell(table, 0, "pairs"), "1");
}

TEST_F(Queries, AMissingLibraryIsNamed) {
    if (have("mujoco")) {
        GTEST_SKIP() << "libmujoco-dev is here";
    }
    const ExperimentResult result = run(queries_experiment + "engines: mujoco\n");
    EXPECT_THAT(result.markdown, HasSubstr("| arm | not measured | not measured | not measured |"));
    EXPECT_THAT(
        result.markdown,
        HasSubstr("arm: the program foam-engine-mujoco is not built; remedy: apt-get install libmujoco-dev, then "
                  "configure and build foam again"));
}

TEST_F(Queries, CertifiedSpheresMissNothingAndVerdictsAreTheSameEveryTime) {
    if (!have("fcl")) {
        GTEST_SKIP() << "libfcl-dev is not here";
    }
    const std::string text = queries_experiment + "engines: [fcl, fcl_pairs]\nseed: 3\n";
    const ExperimentResult result = run(text);
    EXPECT_THAT(result.markdown, ::testing::ContainsRegex("certified; of [1-9][0-9]* such hits of obstacles, over all "
                                                          "libraries, their spheres missed 0, of "));
    const Table first = parse_csv(result.csv, "a"), second = parse_csv(run(text).csv, "b");
    for (std::size_t row = 0; row < first.rows.size(); ++row) {
        for (const char* column : {"shapes", "queries", "aborted", "collides", "collides_alone", "hits_obstacle",
                                   "hits_itself", "mean_distance_m"}) {
            EXPECT_EQ(cell(first, row, column), cell(second, row, column));
            EXPECT_EQ(cell(first, row, column), cell(first, row ^ 2, column)) << "with trees and without, row " << row;
        }
    }
}

TEST_F(Queries, VerdictsAreSplitIntoObstaclesAndTheRobotItself) {
    if (!have("fcl")) {
        GTEST_SKIP() << "libfcl-dev is not here";
    }
    const ExperimentResult result = run(queries_experiment + "engines: fcl\n");
    EXPECT_THAT(result.markdown,
                HasSubstr("| robot | library | collides, % | spheres collide, % | Δ, % | Δ by obstacles, % "
                          "| Δ by itself, % | only spheres | only the original |"));
    const Table table = parse_csv(result.csv, "results.csv");
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const int all = std::stoi(cell(table, row, "collides"));
        const int obstacle = std::stoi(cell(table, row, "hits_obstacle"));
        const int itself = std::stoi(cell(table, row, "hits_itself"));
        EXPECT_LE(std::max(obstacle, itself), all);
        EXPECT_GE(obstacle + itself, all);
    }
}

TEST_F(Queries, DistancesOfEachEngine) {
    if (!have("fcl")) {
        GTEST_SKIP() << "libfcl-dev is not here";
    }
    std::string text = queries_experiment + "engines: [fcl, fcl_pairs]\n";
    text.replace(text.find("distances: 5"), 12, "distances: {fcl: 7}");
    const ExperimentResult result = run(text);
    EXPECT_THAT(result.markdown, HasSubstr("to itself: 7 in FCL; 0 in FCL, pair by pair. The two models"));
    const Table table = parse_csv(result.csv, "results.csv");
    ASSERT_EQ(table.rows.size(), 8u); // 2 robots, 2 engines, 2 models
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        EXPECT_EQ(cell(table, row, "queries"), "20");
        EXPECT_EQ(cell(table, row, "distances"), cell(table, row, "engine") == "fcl" ? "7" : "0");
    }
}

TEST_F(Running, Fidelity) {
    ::setenv("XDG_CACHE_HOME", (path() / "cache").c_str(), 1);
    write("pair.urdf", "<robot name='pair'>"
                       "<link name='a'><visual><geometry><sphere radius='1'/></geometry></visual>"
                       "<collision><geometry><box size='1 1 1'/></geometry></collision></link>"
                       "<link name='b'><collision><geometry><box size='1 1 2'/></geometry></collision></link>"
                       "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>");
    const ExperimentResult result =
        run("foam_experiment: 1\nname: x\nkind: fidelity\nrobot: [no.urdf, pair.urdf]\nmethod: spherize.octree\n"
            "spheres: [2, 4]\nsnapshots: {size: [400, 200], pose: {j: 1}}\n");
    EXPECT_THAT(result.files, UnorderedElementsAre("results.csv", "measured_on.csv", "results.md", "fidelity.png"));
    EXPECT_THAT(contents("out/fidelity.png"), testing::StartsWith("\x89PNG"));
    EXPECT_THAT(result.markdown, HasSubstr("![x](fidelity.png)"));
    EXPECT_THAT(result.markdown, HasSubstr("| spheres | made | excess | excess error | mean protrusion, mm "
                                           "| largest protrusion, mm | certified |"));
    // The cubes' circumscribed balls: radii √3/2 and √6/2 around volumes of 1 and 2.
    EXPECT_THAT(result.csv, HasSubstr("\n2,2,2.4"));
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
        EXPECT_THAT(error.what(), HasSubstr("no .foam-run in it"));
    }
    EXPECT_EQ(contents("out/letter.txt"), "dear");
}

} // namespace
} // namespace foam
