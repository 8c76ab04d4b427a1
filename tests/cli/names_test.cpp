// Names: those that mean nothing, and those that would steer a terminal.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class CliNames : public Cli {
protected:
    void SetUp() override {
        write("arm.urdf",
              "<robot name='arm'>\n"
              "<link name='arm_base'><collision><geometry><box size='0.4 0.2 0.2'/></geometry></collision></link>\n"
              "<link name='arm_tip'><collision><geometry><box size='0.1 0.1 0.3'/></geometry></collision></link>\n"
              "<joint name='elbow' type='revolute'><axis xyz='0 0 1'/><parent link='arm_base'/>"
              "<child link='arm_tip'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>\n"
              "</robot>\n");
        write("arm.yaml", "foam: 1\nrobot: {urdf: arm.urdf}\nstages: [spherize.grid]\n"
                          "outputs: [write.urdf: {file: out.urdf}, write.csv: {file: out.csv}]\n");
    }
};

TEST_F(CliNames, ALinkThatIsNoneIsAnErrorInEveryCommand) {
    write("wrong.yaml", contents(path() / "arm.yaml") + "links:\n  arm_tpi: {skip: true}\n");
    const std::string finding = "wrong.yaml:6:3: error[unknown-link]: 'arm_tpi' in 'links' names no link of arm.urdf; "
                                "did you mean 'arm_tip'?\n";
    const Outcome check = foam("check wrong.yaml");
    EXPECT_EQ(check.code, 2);
    EXPECT_EQ(check.out, finding);
    for (const std::string command : {"plan", "run"}) {
        const Outcome outcome = foam(command + " wrong.yaml");
        EXPECT_EQ(outcome.code, 2) << command;
        EXPECT_EQ(outcome.out, "") << command;
        EXPECT_THAT(outcome.err, HasSubstr(finding)) << command;
    }
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/wrong"));
}

TEST_F(CliNames, SoItIsInSettings) {
    for (const std::string setting : {"links.arm_tpi.skip=true", "links.arm_tpi.max_spheres=3",
                                      "links.arm_tpi.clip=[{normal: [0, 0, 1], reach: 0.1}]"}) {
        const Outcome outcome = foam("run arm.yaml --set '" + setting + "'");
        EXPECT_EQ(outcome.code, 2) << setting;
        EXPECT_THAT(outcome.err, HasSubstr("'arm_tpi' in 'links' names no link of arm.urdf; did you mean 'arm_tip'?"));
    }
    EXPECT_EQ(foam("spherize arm.urdf --method grid --set links.arm_tpi.skip=true").code, 2);
}

TEST_F(CliNames, AGlobIsAWarningOrAnErrorIfStrict) {
    const std::string glob = " --set 'links.*finger.skip=true'";
    const Outcome check = foam("check arm.yaml" + glob);
    EXPECT_EQ(check.code, 0) << check.out;
    EXPECT_THAT(check.out, HasSubstr("warning[unknown-link]: '*finger' in 'links' names no link of arm.urdf"));
    EXPECT_EQ(foam("plan arm.yaml" + glob).code, 0);
    const Outcome run = foam("run arm.yaml" + glob);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("foam: warning: --set:1:1: '*finger' in 'links' names no link of arm.urdf"));
    for (const std::string command : {"check", "plan", "run"}) {
        EXPECT_EQ(foam(command + " arm.yaml --strict" + glob).code, 2) << command;
        EXPECT_EQ(foam(command + " arm.yaml --set strict=true" + glob).code, 2) << command;
        EXPECT_EQ(foam(command + " arm.yaml --strict --set 'links.*tip.max_spheres=9'").code, 0) << command;
    }
}

TEST_F(CliNames, AJointThatIsNoneIsAnErrorBeforeAnyWork) {
    for (const std::string setting : {"snapshots={pose: {elbwo: 0.1}}", "self_collision={pose: {elbwo: 0.1}}"}) {
        for (const std::string command : {"check", "plan", "run"}) {
            const Outcome outcome = foam(command + " arm.yaml --set '" + setting + "'");
            EXPECT_EQ(outcome.code, 2) << command;
            EXPECT_THAT(outcome.out + outcome.err, HasSubstr("names no joint of arm.urdf; did you mean 'elbow'?"));
        }
    }
    const Outcome outcome = foam("self-collision arm.urdf --pose elbwo=0.1");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--pose: arm.urdf has no joint 'elbwo'; did you mean 'elbow'?"));
}

TEST_F(CliNames, ARenameOfNothingIsAnError) {
    ASSERT_EQ(foam("run arm.yaml").code, 0);
    for (const std::string command : {"evaluate", "certify", "compare"}) {
        const Outcome outcome = foam(command + " arm.urdf runs/arm/out.csv --rename leg_=arm_");
        EXPECT_EQ(outcome.code, 2) << command;
        EXPECT_THAT(outcome.err,
                    HasSubstr("--rename leg_=arm_: no link of the spheres is called 'leg_' or begins with it"));
    }
}

/// Nothing of a file steers or misleads a terminal: no control byte but line ends, no mark that turns the writing.
void expect_harmless(const std::string& text, const std::string& what) {
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        EXPECT_FALSE((byte < 0x20 && byte != '\n') || byte == 0x7F) << what << ": byte " << int(byte) << " in " << text;
    }
    for (const char* mark : {"\u009b", "\u202e", "\u2066", "\u200f", "\u061c", "\u2028"}) {
        EXPECT_THAT(text, Not(HasSubstr(mark))) << what;
    }
    EXPECT_THAT(text, Not(HasSubstr("\nforged"))) << what;
}

class CliHostileNames : public Cli {
protected:
    void SetUp() override {
        const std::string name = "tip&#10;forged&#9;&#127;&#x9b;31m&#x202e;&#x2066;é";
        write("evil.urdf",
              "<robot name='evil'><link name='base'><collision><geometry><box size='0.4 0.2 0.2'/></geometry>"
              "</collision></link><link name='" +
                  name +
                  "'><collision><geometry><box size='0.1 0.1 0.3'/>"
                  "</geometry></collision></link><joint name='j&#10;forged&#x9b;' type='revolute'><axis xyz='0 0 1'/>"
                  "<parent link='base'/><child link='" +
                  name +
                  "'/>"
                  "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>\n");
        write("evil.yaml", "foam: 1\nrobot: {urdf: evil.urdf}\nstages: [spherize.grid]\nself_collision: true\n"
                           "outputs: [write.urdf: {file: out.urdf}, write.csv: {file: out.csv}]\n");
    }
    void expect_harmless_command(const std::string& arguments) const {
        const Outcome outcome = foam(arguments);
        EXPECT_FALSE(outcome.out.empty() && outcome.err.empty()) << arguments;
        expect_harmless(outcome.out, arguments);
        expect_harmless(outcome.err, arguments);
    }
};

TEST_F(CliHostileNames, NoneReachesTheTerminal) {
    ASSERT_EQ(foam("run evil.yaml").code, 0);
    for (const std::string command : {"run evil.yaml -v",
                                      "run evil.yaml --json",
                                      "plan evil.yaml",
                                      "plan evil.yaml --json",
                                      "check evil.yaml",
                                      "check evil.yaml --set links.tpi.skip=true",
                                      "run evil.yaml --set links.tpi.skip=true",
                                      "check evil.yaml --set 'links.zzzzzzzzz*.skip=true' --strict",
                                      "run evil.yaml --set on_error=skip",
                                      "evaluate evil.urdf runs/evil/out.urdf",
                                      "evaluate evil.urdf runs/evil/out.urdf --json",
                                      "certify evil.urdf runs/evil/out.urdf",
                                      "certify evil.urdf runs/evil/out.csv --link base",
                                      "certify evil.urdf evil.urdf",
                                      "compare evil.urdf runs/evil/out.urdf runs/evil/out.csv",
                                      "self-collision evil.urdf",
                                      "self-collision evil.urdf --json",
                                      "self-collision evil.urdf --pose x=1",
                                      "verify runs/evil",
                                      "spherize evil.urdf --method grid",
                                      "evaluate evil.urdf runs/evil/out.csv --rename a=b"}) {
        expect_harmless_command(command);
    }
}

TEST_F(CliHostileNames, ColumnsHold) {
    const Outcome outcome = foam("run evil.yaml");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\ntip\\x0aforged\\x09\\x7f\\u{009b}31m\\u{202e}\\u{2066}é  "));
    EXPECT_THAT(outcome.out, HasSubstr("\nbase                                               "));
}

/// Names of links, meshes, robots and recipes are text in every place, whatever they hold.
TEST_F(CliHostileNames, PagesShowThemAsText) {
    const std::string markup = "<img src=x onerror=alert(1)>", mesh = "part\u202e\u009b\x7f" + markup + "'\"&.obj";
    write(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    const std::string name = "&#x202e;&#x9b;&#127;&lt;img src=x onerror=alert(1)&gt;&apos;&quot;&amp;";
    const std::string geometry = "<geometry><mesh filename=\"part" + name + ".obj\"/></geometry>";
    write("evil.urdf", "<robot name=\"robot" + name + "\"><link name=\"link&#10;forged" + name + "\"><visual>" +
                           geometry + "</visual><collision>" + geometry + "</collision></link></robot>");
    const std::string recipe = "recipe\u202e\u009b\x07\n" + markup + "\".yaml";
    write(recipe, "foam: 1\nrobot: {urdf: evil.urdf}\nstages: [spherize.grid]\nname: plain\n"
                  "outputs: [write.urdf: {file: out.urdf}]\n");
    for (const std::string& command :
         {"check '" + recipe + "'", "plan '" + recipe + "'", "run '" + recipe + "'", std::string("info evil.urdf"),
          std::string("view evil.urdf runs/plain/out.urdf --html view.html")}) {
        const Outcome outcome = foam(command);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        expect_harmless(outcome.out + outcome.err, command);
    }
    const std::string steers = "\\u{202e}\\u{009b}\\x7f&lt;img src=x onerror=alert(1)&gt;";
    const std::string report = contents(path() / "runs/plain/report.html"), page = contents(path() / "view.html");
    for (const std::string kind : {"part", "robot", "link\\x0aforged"}) {
        EXPECT_THAT(report, HasSubstr(kind + steers));
    }
    for (const auto& [what, html] : {std::pair{"report", report}, std::pair{"view", page}}) {
        expect_harmless(html, what);
        EXPECT_THAT(html, Not(HasSubstr("<img src=x"))) << what;
    }
}

TEST_F(CliHostileNames, NorDoFilesOfSpheres) {
    write("bad.csv", "link,x,y,z,radius\nbase,0,0,\x1b[31m\x07,1\n");
    write("name.csv", "link,x,y,z,radius\nbase,0,0,0,1\n\"\x1b[2J\nforged\xff\",0,0,0,1\n");
    write("rows.txt", "base 0 0 \x1b[31m0 1\n");
    write("list.yaml", "collision_spheres:\n  \"\\e[2Jforged\\u202e\":\n    - {center: [0, 0, 0], radius: 0.1}\n"
                       "  base:\n    - {center: [0, 0, 0], radius: 0.1}\n");
    write("wrong.yaml", "collision_spheres:\n  base:\n    - {center: [0, 0, \"\\e[31m\\u202e\"], radius: 0.1}\n");
    write("raw.yaml", "collision_spheres:\n  base: \x1b[2J\n");
    write("attribute.urdf", "<robot name='x'><link name='a'><collision><geometry><box size='1 &#x9b;2 3'/></geometry>"
                            "</collision></link></robot>");
    for (const std::string file :
         {"bad.csv", "name.csv", "rows.txt", "list.yaml", "wrong.yaml", "raw.yaml", "attribute.urdf"}) {
        for (const std::string command : {"evaluate", "certify"}) {
            expect_harmless_command(command + " evil.urdf " + file);
        }
    }
    expect_harmless_command("spherize attribute.urdf");
    write("bad.yaml", "foam: 1\n\"\\e[2J\": 1\nrobot: {urdf: evil.urdf}\nstages: [\"spherize.\\u202e\"]\n");
    expect_harmless_command("check bad.yaml");
}

} // namespace
} // namespace foam::test
