// foam view as a user runs it.
#include "cli/program.hpp"

#include "arm.hpp"
#include "support/sanitizers.hpp"

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ViewCli : public Cli {
protected:
    ViewCli() {
        write("arm.urdf", arm_urdf);
        write("arm.csv", arm_spheres);
    }
};

TEST_F(ViewCli, WritesOneFile) {
    const Outcome written = foam("view arm.urdf arm.csv --html a.html");
    EXPECT_EQ(written.code, 0) << written.err;
    // "foamview" in base 64; the next digit holds bits of a length, too.
    EXPECT_THAT(contents(path() / "a.html"),
                AllOf(HasSubstr("id=\"scene\">Zm9hbXZpZX"), HasSubstr("Content-Security-Policy")));
    EXPECT_EQ(foam("view arm.urdf arm.csv --html b.html").code, 0);
    EXPECT_EQ(contents(path() / "a.html"), contents(path() / "b.html"));
}

TEST_F(ViewCli, RefusesToOverwriteAnInput) {
    const Outcome refused = foam("view arm.urdf --html arm.urdf");
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(contents(path() / "arm.urdf"), arm_urdf);
}

TEST_F(ViewCli, SaysWhatCannotBeRead) {
    EXPECT_THAT(foam("view").err, HasSubstr("models is required"));
    const Outcome missing = foam("view none.urdf --html a.html");
    EXPECT_NE(missing.code, 0);
    EXPECT_THAT(missing.err, HasSubstr("none.urdf"));
    EXPECT_FALSE(std::filesystem::exists(path() / "a.html"));
    write("odd.yaml", "nothing: here\n");
    EXPECT_THAT(foam("view arm.urdf odd.yaml --html a.html").err, HasSubstr("odd.yaml"));
}

TEST_F(ViewCli, SearchesByTheVisualGeometryOfARobotWithoutOther) {
    write("visual.urdf",
          "<robot name=\"v\"><link name=\"v\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual>"
          "</link></robot>");
    const Outcome written = foam("view visual.urdf --geometry visual --html a.html");
    EXPECT_EQ(written.code, 0) << written.err;
    const Outcome nothing = foam("view visual.urdf --html b.html");
    EXPECT_EQ(nothing.code, 0) << nothing.err;
    EXPECT_THAT(nothing.err, HasSubstr("has no collision geometry: nothing is searched or proved"));
    EXPECT_THAT(foam("view visual.urdf -n 3 --html b.html").err, HasSubstr("no geometry that they could cover"));
}

TEST_F(ViewCli, RefusesNumbersThatThePageDoesNotShow) {
    const Outcome given = foam("view arm.urdf arm.csv -n 8 --html a.html");
    EXPECT_EQ(given.code, 2);
    EXPECT_THAT(given.err, HasSubstr("-n searches for spheres of a robot that is given without a model"));
    EXPECT_FALSE(std::filesystem::exists(path() / "a.html"));
    EXPECT_EQ(foam("view arm.csv -n 8 --no-open").code, 2);
    const Outcome several = foam("view arm.urdf -n 8 -n 4 --no-open");
    EXPECT_EQ(several.code, 2);
    EXPECT_THAT(several.err, HasSubstr("remedy: one -n, or --html FILE"));
}

TEST_F(ViewCli, SortsTheNumbersOfTheSlider) {
    EXPECT_EQ(foam("view arm.urdf -n 8 -n 4 -n 8 --html a.html").code, 0);
    EXPECT_EQ(foam("view arm.urdf -n 4 -n 8 --html b.html").code, 0);
    EXPECT_EQ(contents(path() / "a.html"), contents(path() / "b.html"));
}

TEST_F(ViewCli, ASrdfIsNoOutput) {
    write("arm.srdf", "<robot name=\"arm\"/>");
    EXPECT_EQ(foam("view arm.urdf arm.csv --srdf arm.srdf --html arm.srdf").code, 2);
    EXPECT_EQ(contents(path() / "arm.srdf"), "<robot name=\"arm\"/>");
}

TEST_F(ViewCli, TakesTheStandardInputAsAnyFile) {
    std::filesystem::create_directory(path() / "tmp");
    const auto piped = [&](const std::string& file, const std::string& arguments) {
        return shell("export TMPDIR='@/tmp'; cat " + file + " | '" FOAM_TEST_BINARY "' view " + arguments);
    };
    for (const auto& [file, arguments] : std::vector<std::pair<std::string, std::string>>{
             {"arm.urdf", "- arm.csv"}, {"arm.csv", "arm.urdf -"}, {"arm.csv", "-"}, {"arm.urdf", "- -n 8"}}) {
        const Outcome written = piped(file, arguments + " --html a.html --force");
        EXPECT_EQ(written.code, 0) << arguments << written.err;
        EXPECT_THAT(contents(path() / "a.html"), HasSubstr("id=\"scene\">Zm9hbXZpZX"));
        EXPECT_THAT(written.err, Not(HasSubstr("/foam-")));
    }
    EXPECT_THAT(piped("arm.csv", "- --html b.html").err,
                HasSubstr("warning: stdin: without its robot all links lie in one frame"));
    EXPECT_THAT(piped("arm.urdf", "- - --html b.html").err, HasSubstr("the standard input can be read once"));
    EXPECT_THAT(piped("arm.urdf", "- --input-format obj --html b.html").err,
                HasSubstr("stdin: there are no triangles in it"));
    EXPECT_TRUE(std::filesystem::is_empty(path() / "tmp"));
}

TEST_F(ViewCli, ServesTheStandardInput) {
    if (signals_wait) {
        GTEST_SKIP() << "the thread sanitizer runs no handler of a signal while the server waits for a connection";
    }
    const Outcome served =
        shell("'" FOAM_TEST_BINARY "' view - --no-open < arm.urdf > address.txt 2> told.txt & child=$!; "
              "for i in $(seq 100); do [ -s address.txt ] && break; sleep 0.1; done; kill -TERM $child; "
              "wait $child; echo ended $?");
    EXPECT_EQ(served.out, "ended 130\n");
    EXPECT_THAT(contents(path() / "told.txt"), HasSubstr("only this computer can read the page"));
}

TEST_F(ViewCli, TheFirstSearchCanBeInterrupted) {
    const Outcome served =
        shell("'" FOAM_TEST_BINARY "' view arm.urdf -n 60000 --no-open > address.txt 2> told.txt & child=$!; "
              "sleep 1; kill -TERM $child; wait $child; echo ended $?");
    EXPECT_THAT(served.out, HasSubstr("ended 130"));
    EXPECT_EQ(contents(path() / "address.txt"), ""); // it was at the search
    EXPECT_THAT(contents(path() / "told.txt"), Not(HasSubstr("do not respond")));
}

TEST_F(ViewCli, ServesUntilItIsInterrupted) {
    if (signals_wait) {
        GTEST_SKIP() << "the thread sanitizer runs no handler of a signal while the server waits for a connection";
    }
    const Outcome served = shell(
        "'" FOAM_TEST_BINARY "' view arm.urdf --no-open > address.txt 2> told.txt & child=$!; "
        "for i in $(seq 100); do [ -s address.txt ] && break; sleep 0.1; done; cat address.txt; kill -TERM $child; "
        "wait $child; echo ended $?");
    EXPECT_THAT(served.out, AllOf(::testing::StartsWith("http://127.0.0.1:"), HasSubstr("ended 130")));
    EXPECT_THAT(contents(path() / "told.txt"), HasSubstr("only this computer can read the page"));
}

} // namespace
} // namespace foam::test
