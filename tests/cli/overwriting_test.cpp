// Outputs that are inputs.
#include "program.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;

class CliOverwriting : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("box.urdf", urdf);
    }
    static constexpr const char* urdf =
        "<robot name='b'><link name='base'><collision><geometry><mesh filename='box.obj'/>"
        "</geometry></collision></link></robot>\n";

    void expect_refused(const std::string& arguments, const std::string& message) const {
        const Outcome outcome = foam(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_THAT(outcome.err, HasSubstr(message)) << arguments;
        EXPECT_EQ(outcome.out, "") << arguments;
        EXPECT_EQ(contents(path() / "box.urdf"), urdf) << arguments;
        EXPECT_EQ(contents(path() / "box.obj"), box_obj) << arguments;
    }
};

TEST_F(CliOverwriting, SpherizeLeavesItsInputAlone) {
    std::filesystem::create_symlink("box.urdf", path() / "soft.urdf");
    std::filesystem::create_hard_link(path() / "box.urdf", path() / "hard.urdf");
    std::filesystem::create_symlink("box.obj", path() / "mesh.csv");
    for (const std::string output : {"box.urdf", "./box.urdf", "soft.urdf", "hard.urdf"}) {
        expect_refused("spherize box.urdf -n 3 --method grid -o " + output,
                       output + ": the output would replace the input " + (path() / "box.urdf").string() +
                           "; nothing was written; remedy: another name, or --force");
    }
    expect_refused("spherize box.urdf -n 3 --method grid -o mesh.csv", "mesh.csv: the output would replace the input ");
    const Outcome forced = foam("spherize box.urdf -n 3 --method grid -o box.urdf --force");
    EXPECT_EQ(forced.code, 0) << forced.err;
    EXPECT_THAT(contents(path() / "box.urdf"), HasSubstr("<sphere radius="));
}

TEST_F(CliOverwriting, ARunDoesNotReplaceTheFolderOfItsInput) {
    write("box.yaml", "foam: 1\nrobot: {urdf: [runs/box/robot.urdf, box.urdf]}\nstages: [spherize.grid]\n"
                      "outputs: [write.urdf: {file: robot.urdf}]\n");
    ASSERT_EQ(foam("run box.yaml").code, 0);
    const std::string made = contents(path() / "runs/box/robot.urdf");
    expect_refused("run box.yaml", "runs/box: the run would replace this folder, in which the input ");
    EXPECT_EQ(contents(path() / "runs/box/robot.urdf"), made);
    EXPECT_EQ(foam("run box.yaml --force").code, 0);
}

TEST_F(CliOverwriting, ARecipeInTheFolderOfItsRunStays) {
    write("box.yaml", "foam: 1\nmesh: " + (path() / "box.obj").string() + "\nstages: [spherize.grid]\n"
                      "budget: {spheres: 2}\n");
    ASSERT_EQ(foam("run box.yaml --run-dir runs/r").code, 0);
    std::filesystem::copy_file(path() / "box.yaml", path() / "runs/r/mine.yaml");
    write("runs/r/notes.txt", "notes");
    const Outcome outcome = foam("run runs/r/mine.yaml --run-dir runs/r");
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("mine.yaml"));
    EXPECT_EQ(contents(path() / "runs/r/notes.txt"), "notes");
    EXPECT_EQ(contents(path() / "runs/r/mine.yaml"), contents(path() / "box.yaml"));
}

TEST_F(CliOverwriting, FilesBesideTheOutputLeaveInputsAndFilesOfOthersAlone) {
    ASSERT_EQ(foam("approximate box.obj -n 1 --with hull -o arm.urdf").code, 0);
    std::string hull;
    for (const auto& entry : std::filesystem::directory_iterator(path() / "arm_hulls")) {
        hull = "arm_hulls/" + entry.path().filename().string();
    }
    ASSERT_EQ(foam("approximate box.obj -n 1 --with hull -o arm.urdf").code, 0) << "its own files are replaced";
    const std::string made = contents(path() / hull);
    write("backup.urdf", "<robot name='b'><link name='box'><collision><geometry><mesh filename='" + hull +
                             "' scale='2 2 2'/></geometry></collision></link></robot>");
    const Outcome outcome = foam("approximate backup.urdf -n 1 --with hull -o arm.urdf");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(hull + ": the output would replace the input "));
    EXPECT_EQ(contents(path() / hull), made);
    std::filesystem::create_directory(path() / "mine_hulls");
    const std::string theirs = "mine_hulls/" + hull.substr(10);
    write(theirs, "v 0 0 0\n");
    EXPECT_THAT(foam("approximate box.obj -n 1 --with hull -o mine.urdf").err,
                HasSubstr(theirs + ": the output would replace this file, which does not belong to an earlier "
                                   "mine.urdf; nothing was written; remedy: another name, or --force"));
    EXPECT_EQ(contents(path() / theirs), "v 0 0 0\n");
    EXPECT_EQ(foam("approximate box.obj -n 1 --with hull -o mine.urdf --force").code, 0);
}

TEST_F(CliOverwriting, OtherCommandsLeaveTheirInputsAlone) {
    ASSERT_EQ(foam("spherize box.urdf -n 3 --method grid -o s.urdf").code, 0);
    const std::string spheres = contents(path() / "s.urdf");
    for (const std::string target : {"box.urdf", "s.urdf"}) {
        expect_refused("compare box.urdf s.urdf --html " + target, target + ": the output would replace the input ");
        expect_refused("self-collision box.urdf --model s.urdf --srdf " + target,
                       target + ": the output would replace the input ");
        expect_refused("self-collision box.urdf --model s.urdf --curobo " + target,
                       target + ": the output would replace the input ");
    }
    EXPECT_EQ(contents(path() / "s.urdf"), spheres);
}

} // namespace
} // namespace foam::test
