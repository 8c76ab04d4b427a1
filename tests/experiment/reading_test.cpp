// What is wrong with an experiment is told exactly, all at once.
#include "experiments.hpp"

namespace foam {
namespace {

using Reading = ExperimentTest;

const std::string head = "foam_experiment: 1\nname: x\n";
const std::string time = head + "kind: time_against_triangles\n";
const std::string quality = head + "kind: quality_against_spheres\n";

TEST_F(Reading, GoodOnes) {
    const auto a = parse_experiment(time + "title: T\nmesh: a.stl\ntriangles: [10, 20]\nfigures:\n  all:\n"
                                           "    - load.mesh\n    - repair.soup\n    - [smooth.taubin, spherize.grid]\n",
                                    "x.yaml", registry);
    ASSERT_TRUE(a.ok());
    EXPECT_EQ(a.experiment->kind, "time_against_triangles");
    EXPECT_EQ(a.experiment->name, "x");
    EXPECT_EQ(a.experiment->title, "T");
    EXPECT_EQ(a.experiment->stages(),
              (std::set<std::string>{"load.mesh", "repair.soup", "smooth.taubin", "spherize.grid"}));
    const auto b =
        parse_experiment(quality + "robots: {r: r.urdf}\nfilters: [repair.soup]\n"
                                   "methods: [spherize.grid, [smooth.taubin, spherize.grid]]\nspheres: [1]\n",
                         "x.yaml", registry);
    ASSERT_TRUE(b.ok());
    EXPECT_EQ(b.experiment->title, "x");
    EXPECT_EQ(b.experiment->stages(), (std::set<std::string>{"repair.soup", "smooth.taubin", "spherize.grid"}));
}

TEST_F(Reading, NoExperiment) {
    EXPECT_EQ(findings(""), "x.yaml:1:1: error[wrong-type]: an experiment is a map, got nothing; remedy: begin with "
                            "'foam_experiment: 1'\n");
    EXPECT_EQ(findings("name: x\n"), "x.yaml:1:1: error[missing-key]: the version of the experiment format is missing; "
                                     "remedy: begin with 'foam_experiment: 1'\n");
    EXPECT_EQ(findings("foam: 1\n"),
              "x.yaml:1:1: error[missing-key]: this is a recipe; remedy: run it by `foam run`\n");
    EXPECT_EQ(findings("foam_experiment: 1\nname: x\n"),
              "x.yaml:1:1: error[missing-key]: 'kind' is missing; remedy: write kind: time_against_triangles\n");
    EXPECT_EQ(
        findings("foam_experiment: 1\nkind: time_against_triangle\n"),
        "x.yaml:2:7: error[unknown-choice]: 'kind' expects one of time_against_triangles, program_against_size, "
        "quality_against_spheres, "
        "collision_queries, element_checks, fidelity, throughput, got the text 'time_against_triangle'; did you mean "
        "'time_against_triangles'?\n");
}

TEST_F(Reading, AllThatIsMissing) {
    EXPECT_EQ(findings("foam_experiment: 2\nkind: time_against_triangles\n"),
              "x.yaml:1:1: error[missing-key]: 'mesh' is missing; remedy: write mesh: FILE\n"
              "x.yaml:1:1: error[missing-key]: 'triangles' is missing; remedy: write triangles: [500, 1000, 2000]\n"
              "x.yaml:1:1: error[missing-key]: 'figures' is missing; remedy: write figures: {repair: [repair.soup]}\n"
              "x.yaml:1:1: error[missing-key]: 'name' is missing; remedy: write name: my_experiment\n"
              "x.yaml:1:18: error[version]: this foam reads experiment format 1, the file says 2; remedy: write "
              "'foam_experiment: 1'\n");
    EXPECT_EQ(findings(quality),
              "x.yaml:1:1: error[missing-key]: 'robots' is missing; remedy: write robots: {panda: FILE.urdf}\n"
              "x.yaml:1:1: error[missing-key]: 'methods' is missing; remedy: write methods: [spherize.grid]\n"
              "x.yaml:1:1: error[missing-key]: 'spheres' is missing; remedy: write spheres: [1, 2, 4, 8]\n");
}

TEST_F(Reading, WrongValues) {
    EXPECT_EQ(
        findings(time + "mesh: a.stl\nrepeat: 3\ntime_limit: 10 s\ntriangles: [500, 2, 400]\nfigures:\n"
                        "  a/b: [repair.soup]\n  c: [repair.sop, repair.soup: {largest_hol: 3}, write.csv]\n"
                        "  d: [[spherize.grid, repair.soup], [repair.soup, load.mesh], repair.soup, repair.soup]\n"),
        "x.yaml:5:1: error[unknown-key]: unknown key 'repeat'; did you mean 'repeats'?\n"
        "x.yaml:6:13: error[wrong-type]: 'time_limit' expects a number between 0.001 and 1000000, got the text "
        "'10 s'; remedy: write the bare number, in s\n"
        "x.yaml:7:18: error[out-of-bounds]: 'triangles' expects an integer between 4 and 10000000, got 2\n"
        "x.yaml:7:21: error[out-of-order]: 'triangles' expects ascending numbers, got 400 after 500\n"
        "x.yaml:9:3: error[bad-name]: 'a/b' names the file of a figure, but holds other characters than letters, "
        "digits, _ - + = and .\n"
        "x.yaml:10:7: error[unknown-stage]: unknown stage 'repair.sop'; did you mean 'repair.soup'?\n"
        "x.yaml:10:33: error[unknown-key]: unknown key 'largest_hol' in repair.soup; did you mean 'largest_hole'?\n"
        "x.yaml:10:50: error[wrong-kind]: 'write.csv' is a writer; 'c' holds mesh loaders, mesh filters and "
        "spherizers\n"
        "x.yaml:11:23: error[wrong-kind]: 'repair.soup' stands behind the spherizer 'spherize.grid'; remedy: move it "
        "before that\n"
        "x.yaml:11:51: error[wrong-kind]: 'load.mesh' is a mesh loader behind another stage; remedy: make it the "
        "first\n"
        "x.yaml:11:76: error[duplicate-value]: 'repair.soup' is in 'd' twice; remedy: delete one\n");
}

TEST_F(Reading, StagesWhereTheyDoNotBelong) {
    EXPECT_EQ(
        findings(quality + "robots: {r: r.urdf}\nspheres: [1]\nfilters: [spherize.grid]\n"
                           "methods: [repair.soup, load.mesh, spherize.grid: {isolate: process}]\n"),
        "x.yaml:6:11: error[wrong-kind]: 'spherize.grid' is a spherizer; 'filters' holds mesh filters\n"
        "x.yaml:7:10: error[missing-stage]: the method 'repair.soup' has no spherizer; remedy: add one as its last "
        "stage\n"
        "x.yaml:7:24: error[wrong-kind]: 'load.mesh' is a mesh loader; 'methods' holds mesh filters and spherizers\n"
        "x.yaml:7:35: error[unsupported]: 'spherize.grid' is measured in this process; remedy: delete isolate, "
        "time_limit, memory_limit\n");
}

const std::string checks = head + "kind: element_checks\n";

TEST_F(Reading, ElementChecks) {
    const auto good = parse_experiment(checks + "robots: {r: [a.urdf, b.urdf]}\nmethods: [spherize.grid]\n"
                                                "elements: [1, 3]\nengines: [bullet]\nposes: 4\n",
                                       "x.yaml", registry);
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(good.experiment->stages(), (std::set<std::string>{"spherize.grid"}));
    EXPECT_EQ(findings(checks),
              "x.yaml:1:1: error[missing-key]: 'robots' is missing; remedy: write robots: {panda: FILE.urdf}\n"
              "x.yaml:1:1: error[missing-key]: 'methods' is missing; remedy: write methods: [spherize.cover, "
              "approximate.capsules]\n"
              "x.yaml:1:1: error[missing-key]: 'elements' is missing; remedy: write elements: [1, 2]\n");
    EXPECT_EQ(
        findings(checks + "robots: {}\nmethods: [repair.soup]\nelements: [2, 1]\nengines: fcll\nposes: 0\n"),
        "x.yaml:4:9: error[wrong-type]: 'robots' expects at least one robot\n"
        "x.yaml:5:10: error[missing-stage]: the method 'repair.soup' has no spherizer; remedy: add one as its last "
        "stage\n"
        "x.yaml:6:15: error[out-of-order]: 'elements' expects ascending numbers, got 1 after 2\n"
        "x.yaml:7:10: error[unknown-choice]: 'engines' holds fcl, fcl_pairs, bullet, mujoco, got 'fcll'; did you mean "
        "'fcl'?\n"
        "x.yaml:8:8: error[out-of-bounds]: 'poses' expects an integer between 1 and 1000000, got 0\n");
}

const std::string collision = head + "kind: collision_queries\n";

TEST_F(Reading, CollisionQueries) {
    const auto good =
        parse_experiment(collision + "robots: {r: {urdf: [a.urdf, b.urdf], spheres: 8}, "
                                     "s: {urdf: a.urdf, spheres: s.urdf}}\n"
                                     "method: [repair.soup, spherize.grid]\nengines: bullet\nqueries: 10\n",
                         "x.yaml", registry);
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(good.experiment->stages(), (std::set<std::string>{"repair.soup", "spherize.grid"}));
    EXPECT_EQ(findings(collision),
              "x.yaml:1:1: error[missing-key]: 'robots' is missing; remedy: write robots: {panda: {urdf: FILE.urdf, "
              "spheres: 60}}\n");
    EXPECT_EQ(
        findings(collision + "robots: {r: {urdf: a.urdf, spheres: 8}}\n"),
        "x.yaml:4:13: error[missing-key]: 'r' is to get 8 spheres, but 'method' is missing; remedy: write method: "
        "spherize.medial\n");
    EXPECT_EQ(findings(collision + "robots: {r: {spheres: s.urdf, size: 3}}\n"),
              "x.yaml:4:13: error[missing-key]: 'r' needs 'urdf'; remedy: write r: {urdf: FILE.urdf, spheres: 60}\n"
              "x.yaml:4:31: error[unknown-key]: unknown key 'size' in r; known: urdf, spheres\n");
    const std::string robots = "robots: {s: {urdf: a.urdf, spheres: s.urdf}}\n";
    EXPECT_EQ(
        findings(collision + robots + "engines: [fcl, bulet, fcl]\n"),
        "x.yaml:5:16: error[unknown-choice]: 'engines' holds fcl, fcl_pairs, bullet, mujoco, got 'bulet'; did you "
        "mean 'bullet'?\nx.yaml:5:23: error[twice]: 'engines' holds 'fcl' twice\n");
    EXPECT_EQ(
        findings(collision + robots + "engines: [fcl, bullet]\ndistances: {bulet: 3, mujoco: 4, fcl: -1}\n"),
        "x.yaml:6:13: error[unknown-choice]: 'distances' names 'bulet', which 'engines' has not; did "
        "you mean 'bullet'?\n"
        "x.yaml:6:23: error[unknown-choice]: 'distances' names 'mujoco', which 'engines' has not; known: fcl, bullet\n"
        "x.yaml:6:39: error[out-of-bounds]: 'distances' expects an integer between 0 and 100000000, got -1\n");
    EXPECT_EQ(findings(collision + robots + "distances: many\n"),
              "x.yaml:5:12: error[wrong-type]: 'distances' expects an integer between 0 and 100000000, got the text "
              "'many'\n");
    EXPECT_EQ(findings(collision + robots + "method: repair.soup\nsmallest: 0.5\n"),
              "x.yaml:1:1: error[out-of-order]: 'smallest' is 0.5 m and 'largest' 0.3 m; remedy: the other way round\n"
              "x.yaml:5:9: error[missing-stage]: 'method' has no spherizer; remedy: add one as its last stage\n");
    EXPECT_EQ(findings(collision + robots + "queries: 0\n"),
              "x.yaml:5:10: error[out-of-bounds]: 'queries' expects an integer between 1 and 100000000, got 0\n");
}

TEST_F(Reading, Fidelity) {
    const std::string fidelity = head + "kind: fidelity\n";
    EXPECT_EQ(findings(fidelity),
              "x.yaml:1:1: error[missing-key]: 'robot' is missing; remedy: write robot: FILE.urdf\n"
              "x.yaml:1:1: error[missing-key]: 'method' is missing; remedy: write method: spherize.medial\n"
              "x.yaml:1:1: error[missing-key]: 'spheres' is missing; remedy: write spheres: [11, 22]\n"
              "x.yaml:1:1: error[missing-key]: 'snapshots' is missing; remedy: write snapshots: {size: [2520, 720]}\n");
    EXPECT_EQ(
        findings(fidelity + "robot: a.urdf\nmethod: spherize.grid\nspheres: [2]\nsnapshots: true\ncolour: red\n"),
        "x.yaml:7:12: error[wrong-type]: 'snapshots' expects a map, got true; remedy: write snapshots: {size: "
        "[2520, 720]}\nx.yaml:8:1: error[unknown-key]: unknown key 'colour'; known: robot, method, spheres, snapshots, "
        "foam_experiment, name, title, kind\n");
}

} // namespace
} // namespace foam
