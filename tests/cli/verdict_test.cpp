// One verdict: a file counts as proved only with the numbers that its reader uses, and only if no link is missing.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class CliVerdict : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("empty.obj", "");
        write("arm.urdf",
              "<robot name='arm'><link name='base'><collision><geometry><mesh filename='box.obj'/></geometry></collision></link>"
              "<link name='tip'><collision><geometry><mesh filename='empty.obj'/></geometry></collision></link>"
              "<joint name='j' type='revolute'><parent link='base'/><child link='tip'/><axis xyz='0 0 1'/>"
              "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>");
        write("whole.urdf",
              "<robot name='arm'><link name='base'><collision><geometry><box size='0.2 0.1 0.3'/></geometry></collision></link>"
              "<link name='tip'/><joint name='j' type='revolute'><parent link='base'/><child link='tip'/><axis xyz='0 0 1'/>"
              "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>");
    }
    std::string curobo_recipe(const std::string& buffer) const {
        return "foam: 1\nrobot: {urdf: [whole.urdf], tool_frames: [tip]}\nstages: [spherize.grid]\nbudget: {spheres: 4}\n"
               "outputs:\n  - write.curobo: {file: out.yml, buffer: " +
               buffer + "}\n";
    }
};

TEST_F(CliVerdict, ABufferIsPartOfWhatIsProved) {
    write("shrunk.yaml", curobo_recipe("-0.05"));
    const Outcome refused = foam("run shrunk.yaml --run-dir shrunk");
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("link 'base': the certificate does not hold"));
    EXPECT_THAT(refused.err, HasSubstr("with its buffer, the file's reader takes radii that are 0.05 m less than the model's"));
    EXPECT_FALSE(fs::exists(path() / "shrunk/out.yml"));

    write("grown.yaml", curobo_recipe("0.05"));
    ASSERT_EQ(foam("run grown.yaml --run-dir grown").code, 0);
    EXPECT_EQ(foam("certify whole.urdf grown/out.yml").code, 0);
    EXPECT_EQ(shell("sed -i 's/collision_sphere_buffer: 0.05/collision_sphere_buffer: -0.05/' grown/out.yml").code, 0);
    EXPECT_EQ(foam("certify whole.urdf grown/out.yml").code, 1);
}

TEST_F(CliVerdict, ConvertWritesNoFileWhoseReaderTakesLess) {
    write("model.csv", "link,x,y,z,radius\nbase,0,0,0,0.3\n");
    const std::string convert = "convert model.csv whole.urdf --format curobo --tool-frame tip -o out.yml --set buffer=";
    const Outcome refused = foam(convert + "-0.05");
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("with its buffer, the file's reader takes smaller spheres"));
    EXPECT_FALSE(fs::exists(path() / "out.yml"));
    EXPECT_EQ(foam(convert + "0.05").code, 0);
}

TEST_F(CliVerdict, UnitsAndFramesOfJsonAreRead) {
    ASSERT_EQ(foam("spherize box.obj -n 2 -m grid -o out.json").code, 0);
    ASSERT_EQ(shell("sed 's/\"units\": \"m\"/\"units\": \"mm\"/' out.json >mm.json").code, 0);
    ASSERT_EQ(shell("sed 's/\"frame\": \"link\"/\"frame\": \"world\"/' out.json >world.json").code, 0);
    EXPECT_EQ(foam("certify box.obj out.json").code, 0);
    EXPECT_THAT(foam("certify box.obj mm.json").err, HasSubstr("units is the text 'mm'; foam reads 'm' alone"));
    EXPECT_THAT(foam("certify box.obj world.json").err, HasSubstr("frame is the text 'world'; foam reads 'link' alone"));
}

TEST_F(CliVerdict, CollisionsOfAnSdfWithoutAMaskDoNotCount) {
    const auto sdf = [&](const std::string& mask) {
        return "<sdf version='1.9'><model name='arm'><link name='base'><collision name='c'><geometry><sphere><radius>0.3</radius>"
               "</sphere></geometry><surface><contact><collide_bitmask>" +
               mask + "</collide_bitmask></contact></surface></collision></link></model></sdf>";
    };
    for (const char* mask : {"0", "0x00", " 00 "}) {
        write("model.sdf", sdf(mask));
        EXPECT_EQ(foam("certify whole.urdf model.sdf").code, 1) << mask;
    }
    for (const char* mask : {"1", "0x0f", "65535"}) {
        write("model.sdf", sdf(mask));
        EXPECT_EQ(foam("certify whole.urdf model.sdf").code, 0) << mask;
    }
}

TEST_F(CliVerdict, AFileWithoutSomeLinkIsNotCertified) {
    EXPECT_EQ(foam("spherize arm.urdf -n 2 -m grid -o failed.json --set on_error=skip").code, 4);
    EXPECT_EQ(foam("spherize arm.urdf -n 2 -m grid -o skipped.json --set links.tip.skip=true").code, 0);
    for (const char* file : {"failed.json", "skipped.json"}) {
        const json model = json::parse(contents(path() / file));
        EXPECT_EQ(model.at("certified"), false) << file;
        EXPECT_EQ(model.at("uncovered_links"), json({"tip"})) << file;
    }
    EXPECT_EQ(foam("spherize arm.urdf -n 2 -m grid -o left_out.json --set links.tip.collision=none").code, 0);
    const json left_out = json::parse(contents(path() / "left_out.json"));
    EXPECT_EQ(left_out.at("certified"), false) << "the link has geometry, and no element here";
    EXPECT_EQ(left_out.at("uncovered_links"), json({"tip"}));

    write("skipped.yaml", "foam: 1\nrobot: {urdf: [arm.urdf], tool_frames: [tip]}\nstages: [spherize.grid]\nbudget: {spheres: 2}\n"
                          "links: {tip: {skip: true}}\noutputs: [write.urdf: {file: out.urdf}, write.plainmp: {file: out.yml}]\n");
    ASSERT_EQ(foam("run skipped.yaml --run-dir skipped").code, 0);
    const std::string header = contents(path() / "skipped/out.yml");
    EXPECT_THAT(header, HasSubstr("proved in part: the collision geometry of 1 of 2 links lies inside their spheres, as a solid"));
    EXPECT_THAT(header, HasSubstr("; not part of the proof: tip (skip in the recipe)\n"));
    EXPECT_THAT(contents(path() / "skipped/out.urdf"), HasSubstr("empty.obj")) << "a link that is skipped keeps its geometry";
}

/// The capsule is proved as one; its parts are proved around the polyhedron that encloses the round original.
TEST_F(CliVerdict, ConvertProvesWhatStandsInTheFile) {
    write("thin.urdf",
          "<robot name='r'><link name='base'><collision><origin xyz='0.13585946813170713 -0.9153292464379559 "
          "-0.6616459293915666' rpy='0.3 0.2 0.1'/><geometry><capsule radius='0.001' length='0.911202140284171'/></geometry>"
          "</collision></link></robot>");
    ASSERT_EQ(foam("approximate thin.urdf -n 1 --with capsule -o thin.json").code, 0);
    for (const char* form : {"element", "as_parts"}) {
        const Outcome outcome = foam(std::string("convert thin.json thin.urdf -o out.urdf --set capsules=") + form);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const bool proved = foam("certify thin.urdf out.urdf").code == 0;
        EXPECT_THAT(outcome.out, HasSubstr(proved ? "\nProved: the" : "\nNot proved: the")) << form;
    }
}

/// foam's own line in a file that is edited tells of the elements before.
TEST_F(CliVerdict, AnEditedFileHasTheVerdictOfItsNewElements) {
    write("good.csv", "link,x,y,z,radius\nbase,0,0,0,0.3\n");
    write("bad.csv", "link,x,y,z,radius\nbase,0,0,0,0.1\n");
    for (const char* format : {"curobo --tool-frame tip", "xrdf --tool-frame tip", "srdf"}) {
        const std::string as = std::string(" --format ") + format;
        ASSERT_EQ(foam("convert good.csv whole.urdf -o good.txt" + as).code, 0) << format;
        EXPECT_THAT(contents(path() / "good.txt"), HasSubstr("; proved: the")) << format;
        const Outcome edited = foam("convert bad.csv whole.urdf --into good.txt -o bad.txt" + as);
        ASSERT_EQ(edited.code, 0) << format << ": " << edited.err;
        EXPECT_THAT(contents(path() / "bad.txt"), HasSubstr("; not proved: the")) << format;
        EXPECT_THAT(contents(path() / "bad.txt"), Not(HasSubstr("; proved: the"))) << format;
    }
}

/// A link that is skipped keeps its primitives where the format has words for them.
TEST_F(CliVerdict, MjcfKeepsTheGeometryOfSkippedLinks) {
    write("two.urdf",
          "<robot name='two'><link name='base'><collision><geometry><box size='0.2 0.1 0.3'/></geometry></collision></link>"
          "<link name='tip'><collision><geometry><cylinder radius='0.1' length='0.2'/></geometry></collision></link>"
          "<joint name='j' type='revolute'><parent link='base'/><child link='tip'/><axis xyz='0 0 1'/>"
          "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>");
    ASSERT_EQ(foam("spherize two.urdf -n 4 -m grid -o two.mjcf --set links.tip.skip=true").code, 0);
    EXPECT_THAT(contents(path() / "two.mjcf"), HasSubstr("type=\"cylinder\""));
    EXPECT_EQ(foam("certify two.urdf two.mjcf").code, 0);
}

/// Names of links and files may hold what ends lines.
TEST_F(CliVerdict, NamesWithLineEndsAndTabsAreKept) {
    write("odd.urdf", "<robot name='r'><link name='l&#10;i&#9;k'><collision><geometry><box size='1 1 1'/></geometry></collision>"
                      "</link></robot>");
    ASSERT_EQ(foam("spherize odd.urdf -n 2 -m grid -o odd.json").code, 0);
    for (const char* file : {"odd.mjcf", "odd.srdf", "odd.csv"}) {
        const Outcome outcome = foam(std::string("convert odd.json odd.urdf -o ") + file);
        EXPECT_EQ(outcome.code, 0) << file << ": " << outcome.err;
        EXPECT_EQ(foam(std::string("certify odd.urdf ") + file).code, 0) << file;
    }
    ASSERT_EQ(shell("cp box.obj \"$(printf 'a\\377.obj')\"").code, 0);
    const Outcome refused = shell("'" FOAM_TEST_BINARY "' spherize \"$(printf 'a\\377.obj')\" -n 2 -o a.json");
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("its name is not UTF-8"));
}

/// Shells of boxes around the surface of a cylinder leave its middle out.
class CliSurface : public Cli {
protected:
    void SetUp() override {
        write("rod.urdf", "<robot name='r'><link name='base'><collision><geometry><cylinder radius='0.05' length='0.2'/></geometry>"
                          "</collision></link></robot>");
        ASSERT_EQ(foam("approximate rod.urdf -n 16 --with box --covers surface -o shell.json").code, 0);
    }
};

TEST_F(CliSurface, TheSentenceAndTheTableOfARunSaySo) {
    write("shell.yaml", "foam: 1\nrobot: {urdf: rod.urdf}\nstages: [approximate.boxes]\nbudget: {spheres: 16}\ncovers: surface\n"
                        "outputs: [write.urdf: {file: out.urdf}, write.mjcf: {file: out.mjcf}, write.json: {file: out.json}]\n");
    const Outcome outcome = foam("run shell.yaml --run-dir shell");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("elements    excess   missing    gap mm"));
    EXPECT_THAT(outcome.out, HasSubstr("Proved: the collision geometry of 1 of 1 link lies inside its elements, as a surface.\n"
                                       "As a surface: base (covers: surface).\n"));
    EXPECT_THAT(outcome.out, HasSubstr("% of the volume lies outside all elements.\n"));
    const json manifest = json::parse(contents(path() / "shell/manifest.json"));
    EXPECT_GT(manifest["proof"]["missing"], 0.1);
    const std::string statement = manifest["proof"]["statement"];
    EXPECT_THAT(statement, HasSubstr("proved: the collision geometry of 1 of 1 link lies inside its elements, as a surface; "));
    EXPECT_THAT(contents(path() / "shell/out.mjcf"), HasSubstr(statement)) << "header, manifest: one sentence";
    EXPECT_THAT(contents(path() / "shell/report.html"), HasSubstr("lies inside its elements, as a surface"));
    const json model = json::parse(contents(path() / "shell/out.json"));
    EXPECT_EQ(model["covers"], "surface");
    EXPECT_EQ(model["surface_links"], json::array({"base"}));
    EXPECT_EQ(model["missing"], manifest["proof"]["missing"]);
}

TEST_F(CliSurface, SoDoCertifyEvaluateAndConvert) {
    const Outcome hollow = foam("certify rod.urdf shell.json");
    EXPECT_EQ(hollow.code, 1) << hollow.err;
    EXPECT_THAT(hollow.out, HasSubstr("inside")) << "where: not on a triangle";
    EXPECT_THAT(hollow.out, HasSubstr("Not certified (outer): 1 of 1 link.\n"));
    const Outcome certified = foam("certify rod.urdf shell.json --covers surface");
    EXPECT_EQ(certified.code, 0) << certified.err;
    EXPECT_THAT(certified.out, HasSubstr("Certified (outer): the geometry lies inside the elements on 1 link, as a surface"));
    EXPECT_THAT(certified.out, HasSubstr("% of the volume lies outside all elements.\n"));
    const json evaluated = json::parse(foam("evaluate rod.urdf shell.json --covers surface --json").out);
    EXPECT_THAT(std::string(evaluated["proof"]["statement"]), HasSubstr("as a surface"));
    const Outcome converted = foam("convert shell.json rod.urdf --covers surface -o shell.urdf");
    EXPECT_EQ(converted.code, 0) << converted.err;
    EXPECT_THAT(converted.out, HasSubstr("Proved: the collision geometry of 1 of 1 link lies inside its elements, as a surface"));
}

/// Thin boxes on the faces of a rod across the axes, whose volume along lines is more than its own.
TEST_F(CliSurface, NoMoreThanAllOfTheVolumeIsMissing) {
    const double half[] = {1, 0.01, 0.01}, c = std::cos(0.61), s = std::sin(0.61), wall = 1e-5;
    std::ostringstream mesh, boxes;
    mesh.precision(17), boxes.precision(17);
    for (int corner = 0; corner < 8; ++corner) {
        const double x = corner & 1 ? 1 : -1, y = corner & 2 ? 0.01 : -0.01, z = corner & 4 ? 0.01 : -0.01;
        mesh << "v " << c * x - s * y << ' ' << s * x + c * y << ' ' << z << '\n';
    }
    mesh << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        double at[] = {0, 0, 0}, size[] = {2 * (half[0] + wall), 2 * (half[1] + wall), 2 * (half[2] + wall)};
        at[axis] = side % 2 ? half[axis] : -half[axis];
        size[axis] = 2 * wall;
        boxes << (side ? ", " : "") << R"({"kind": "box", "position": [)" << c * at[0] - s * at[1] << ", "
              << s * at[0] + c * at[1] << ", " << at[2] << R"(], "rotation": [[)" << c << ", " << -s << ", 0], [" << s
              << ", " << c << R"(, 0], [0, 0, 1]], "size": [)" << size[0] << ", " << size[1] << ", " << size[2] << "]}";
    }
    write("needle.obj", mesh.str());
    write("walls.json",
          R"({"foam_spheres": 2, "units": "m", "frame": "link", "links": {"needle": {"spheres": [], "elements": [)" +
              boxes.str() + "]}}}");
    const Outcome certified = foam("certify needle.obj walls.json --covers surface");
    EXPECT_EQ(certified.code, 0) << certified.err;
    EXPECT_THAT(certified.out, HasSubstr("\n100 % of the volume lies outside all elements.\n"));
}

TEST_F(CliSurface, NothingIsSaidWhereNothingIsMissing) {
    const Outcome outcome = foam("spherize rod.urdf -n 4 -o full.json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, Not(HasSubstr("missing")));
    EXPECT_THAT(outcome.out, HasSubstr("Proved: the collision geometry of 1 of 1 link lies inside its spheres, as a solid.\n"));
    EXPECT_EQ(json::parse(contents(path() / "full.json"))["covers"], "solid");
    EXPECT_THAT(foam("certify rod.urdf full.json").out, HasSubstr("Certified (outer): the geometry lies inside the spheres"));
}

/// A model that was converted is judged, not measured.
TEST_F(CliSurface, AConvertedModelHasItsVerdictAndNoFiguresOfZero) {
    ASSERT_EQ(foam("spherize rod.urdf -n 4 -o full.csv").code, 0);
    ASSERT_EQ(foam("convert full.csv rod.urdf -o full.json").code, 0);
    const json proved = json::parse(contents(path() / "full.json"));
    EXPECT_EQ(proved["certified"], true);
    EXPECT_EQ(proved["guarantee"], "outer");
    const json measures = proved["links"]["base"]["groups"][0]["measures"];
    EXPECT_EQ(measures["certified"], true);
    EXPECT_TRUE(measures["excess"].is_null());
    ASSERT_EQ(shell("sed 's/,[0-9.]*$/,0.01/' full.csv >small.csv").code, 0);
    ASSERT_EQ(foam("convert small.csv rod.urdf -o small.json").code, 0);
    const json open = json::parse(contents(path() / "small.json"));
    EXPECT_EQ(open["certified"], false);
    EXPECT_EQ(open["guarantee"], "fitted");
}

class CliBatchAgain : public Cli {
protected:
    void SetUp() override {
        for (const char* name : {"a", "b"}) {
            fs::create_directories(path() / "set");
            write(std::string("set/") + name + ".obj", box_obj);
        }
    }
    json results() const {
        json by_id;
        std::istringstream lines(foam("batch collect out -o -").out);
        for (std::string line; std::getline(lines, line);) {
            json result = json::parse(line);
            by_id[result.at("id").get<std::string>()] = result;
        }
        return by_id;
    }
};

TEST_F(CliBatchAgain, WhatHasChangedIsDoneAgain) {
    ASSERT_EQ(foam("batch set -n 2 -m grid --run-dir out").code, 0);
    const json before = results();
    ASSERT_EQ(shell("sed -i 's/-0.1/-0.4/' set/b.obj").code, 0);
    ASSERT_EQ(foam("batch set -n 2 -m grid --run-dir out").code, 0);
    const json after = results();
    ASSERT_EQ(after.size(), 2U);
    EXPECT_EQ(after.at("a.obj"), before.at("a.obj"));
    EXPECT_NE(after.at("b.obj").at("digest"), before.at("b.obj").at("digest"));
    EXPECT_NE(after.at("b.obj").at("size_m"), before.at("b.obj").at("size_m"));
}

TEST_F(CliBatchAgain, AShardIsWholeOrAbsent) {
    ASSERT_EQ(foam("batch set -n 2 -m grid --run-dir out").code, 0);
    const json before = results();
    const fs::path shard = path() / "out/shard-00000.jsonl.zst";
    for (const std::uintmax_t size : {std::uintmax_t{0}, fs::file_size(shard) / 2, fs::file_size(shard) - 1}) {
        fs::resize_file(shard, size);
        const Outcome again = foam("batch set -n 2 -m grid --run-dir out");
        EXPECT_EQ(again.code, 0) << again.err;
        json now = results();
        for (auto& [id, result] : now.items()) {
            EXPECT_EQ(result.at("spheres"), before.at(id).at("spheres"));
        }
        EXPECT_EQ(now.size(), 2U);
    }
    fs::resize_file(shard, 0);
    EXPECT_THAT(foam("batch status out").out, HasSubstr("0 of 2 meshes done, 0 of them failed; 0 of 1 shards finished"));
}

} // namespace
} // namespace foam::test
