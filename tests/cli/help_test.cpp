// What the program says of itself: help, completions, manual pages; and foam info.
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <regex>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Cli, HelpOfACommandIsThatOfItsOption) {
    const Outcome outcome = foam("help spherize");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, foam("spherize --help").out);
    EXPECT_EQ(foam("help").out, foam("--help").out);
    const Outcome unknown = foam("help spherise");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("unknown command 'spherise'; did you mean 'spherize'?"));
}

TEST_F(Cli, HelpSpeaksOfElementsWhereAnyMayBe) {
    for (const char* command : {"certify", "evaluate", "view"}) {
        const std::string help =
            std::regex_replace(foam(std::string(command) + " --help").out, std::regex("\\s+"), " ");
        EXPECT_THAT(help, HasSubstr("spheres or other")) << command;
        EXPECT_THAT(help, HasSubstr("elements cover and are judged by")) << command;
        EXPECT_THAT(help, Not(HasSubstr("inside the spheres"))) << command;
    }
}

TEST_F(Cli, AFileInPlaceOfACommandNamesWhatReadsIt) {
    const Outcome robot = foam("robot.urdf");
    EXPECT_EQ(robot.code, 2);
    EXPECT_THAT(robot.err, HasSubstr("'robot.urdf' is a file, not a command; remedy: foam spherize robot.urdf -n 20"));
    EXPECT_THAT(foam("a/recipe.yaml").err, HasSubstr("remedy: foam run a/recipe.yaml"));
}

/// What bash offers for the last of these words.
std::string offers(const std::string& words, int count) {
    return "bash --norc -c 'source <(" FOAM_TEST_BINARY " completion bash); COMP_WORDS=(" + words +
           "); COMP_CWORD=" + std::to_string(count) + "; _foam; echo \"${COMPREPLY[*]}\"'";
}

TEST_F(Cli, BashCompletesCommandsOptionsAndWords) {
    EXPECT_EQ(shell(offers("foam sph", 1)).out, "spherize\n");
    EXPECT_EQ(shell(offers("foam spherize --max", 2)).out, "--max-protrusion\n");
    EXPECT_EQ(shell(offers("foam spherize a.stl --unit m", 4)).out, "mm m\n");
    EXPECT_EQ(shell(offers("foam spherize a", 2)).out, "\n"); // file names, by bash itself
    EXPECT_EQ(shell(offers("foam spherize -o -", 3)).out, "\n");
}

TEST_F(Cli, BashCompletesTheWordsOfArguments) {
    EXPECT_EQ(shell(offers("foam schema man", 2)).out, "manifest\n");
    EXPECT_EQ(shell(offers("foam schema --js", 2)).out, "--json\n");
    EXPECT_EQ(shell(offers("foam completion z", 2)).out, "zsh\n");
    EXPECT_EQ(shell(offers("foam help appr", 2)).out, "approximate\n");
    EXPECT_EQ(shell(offers("foam manual appr", 2)).out, "approximate\n");
    std::string all = shell(offers("foam schema \"\"", 2)).out; // what foam itself lists
    for (std::size_t at = 0; (at = all.find(' ', at)) != all.npos; at += 2) {
        all.replace(at, 1, ", ");
    }
    all.back() = '\n';
    EXPECT_THAT(foam("schema nonsense").err, HasSubstr("there are: " + all));
}

TEST_F(Cli, OtherShellsCompleteTheWordsOfArguments) {
    EXPECT_THAT(foam("completion zsh").out, HasSubstr("'*:value:(recipe manifest spheres "));
    EXPECT_THAT(foam("completion fish").out,
                HasSubstr("'__fish_seen_subcommand_from schema' -f -a 'recipe manifest spheres "));
}

TEST_F(Cli, HelpListsManyWordsInTheText) {
    const std::string help = foam("help schema").out;
    EXPECT_THAT(help, HasSubstr("  what WORD                 The schema; one of recipe, manifest, spheres,\n"));
    EXPECT_THAT(help, HasSubstr("verify, version; default:"));
    EXPECT_THAT(foam("help completion").out, HasSubstr("  shell bash|zsh|fish REQUIRED\n"));
    EXPECT_THAT(foam("manual schema").out, HasSubstr("one of recipe, manifest, spheres"));
}

TEST_F(Cli, CompletionsOfOtherShellsNameEveryCommand) {
    for (const char* name : {"zsh", "fish"}) {
        const Outcome script = foam(std::string("completion ") + name);
        EXPECT_EQ(script.code, 0);
        for (const char* command : {"run", "spherize", "self-collision", "help"}) {
            EXPECT_THAT(script.out, HasSubstr(command)) << name;
        }
    }
    const Outcome unknown = foam("completion tcsh");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("remedy: one of bash, zsh, fish"));
}

TEST_F(Cli, CompletionsAreAcceptedByTheirShells) {
    for (const char* name : {"bash", "zsh", "fish"}) {
        if (shell(std::string("command -v ") + name).code != 0) {
            continue;
        }
        const Outcome outcome =
            shell(std::string("'" FOAM_TEST_BINARY "' completion ") + name + " > script && " + name + " -n script");
        EXPECT_EQ(outcome.code, 0) << name << ": " << outcome.err;
    }
}

TEST_F(Cli, ManualPagesHaveTheirPartsAndNoStrayCommands) {
    const Outcome page = foam("manual spherize");
    EXPECT_EQ(page.code, 0);
    for (const char* part : {".TH FOAM\\-SPHERIZE 1", ".SH SYNOPSIS", ".SH ARGUMENTS", "\\-\\-max\\-protrusion"}) {
        EXPECT_THAT(page.out, HasSubstr(part));
    }
    EXPECT_THAT(foam("manual").out, HasSubstr("foam\\-self\\-collision\\fR(1)"));
    EXPECT_EQ(foam("manual frobnicate").code, 2);
    if (shell("command -v groff").code == 0) {
        const Outcome warnings = shell("'" FOAM_TEST_BINARY "' manual batch | groff -man -ww -Tutf8 -z");
        EXPECT_EQ(warnings.err, "");
    }
}

TEST_F(Cli, InfoOfAMesh) {
    write("box.obj", box_obj);
    const Outcome text = foam("info box.obj");
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("12 triangles, closed 2-manifold"));
    EXPECT_THAT(text.out, HasSubstr("Size: 200.0 x 100.0 x 300.0 mm"));
    EXPECT_THAT(text.out, HasSubstr("Volume: 6000.0 cm3"));
    EXPECT_THAT(text.out, Not(HasSubstr("unusual")));
    EXPECT_THAT(foam("info box.obj --scale 1000").out, HasSubstr("use --unit mm"));
    const auto json = nlohmann::json::parse(foam("info box.obj --unit mm --json").out);
    EXPECT_EQ(json.at("kind"), "mesh");
    EXPECT_NEAR(json.at("links").at(0).at("volume_m3").get<double>(), 6e-12, 1e-18);
}

TEST_F(Cli, InfoOfWhatIsNoFile) {
    const Outcome outcome = foam("info none.stl");
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("none.stl"));
}

} // namespace
} // namespace foam::test
