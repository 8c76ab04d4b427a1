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
    EXPECT_EQ(left_out.at("certified"), true) << "nothing of the output is uncovered";
    EXPECT_FALSE(left_out.contains("uncovered_links"));

    write("skipped.yaml", "foam: 1\nrobot: {urdf: [arm.urdf], tool_frames: [tip]}\nstages: [spherize.grid]\nbudget: {spheres: 2}\n"
                          "links: {tip: {skip: true}}\noutputs: [write.urdf: {file: out.urdf}, write.plainmp: {file: out.yml}]\n");
    ASSERT_EQ(foam("run skipped.yaml --run-dir skipped").code, 0);
    const std::string header = contents(path() / "skipped/out.yml");
    EXPECT_THAT(header, HasSubstr("proved in part: the collision geometry lies inside the spheres of 1 of 2 links"));
    EXPECT_THAT(header, HasSubstr("; without elements: tip\n"));
    EXPECT_THAT(contents(path() / "skipped/out.urdf"), HasSubstr("empty.obj")) << "a link that is skipped keeps its geometry";
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
