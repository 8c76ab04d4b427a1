// --for ENGINE: a file for one program.
#include "program.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliEngine : public Cli {
protected:
    void SetUp() override {
        write("arm.urdf",
              "<robot name='arm'><link name='base'><collision><geometry><box size='0.2 0.1 0.3'/></geometry></collision>"
              "</link><link name='tip'/><joint name='j' type='fixed'><parent link='base'/><child link='tip'/></joint></robot>");
    }
    std::string refusal(const std::string& arguments) {
        const Outcome outcome = foam(arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.out;
        EXPECT_FALSE(std::filesystem::exists(path() / "out.urdf")) << "nothing is written";
        return outcome.err;
    }
};

TEST_F(CliEngine, SaysWhatTheProgramTakesAwayAndProvesWhatItHolds) {
    const Outcome made = foam("approximate arm.urdf --with box -n 1 --for pybullet -o out.urdf");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("Proved: the collision geometry of 1 of 1 link lies"));
    EXPECT_THAT(made.out, HasSubstr("For PyBullet 3.2.7.\n  It rounds edges and corners of boxes"));
    EXPECT_THAT(contents(path() / "out.urdf"), HasSubstr("<box size=\"0.2008")) << "0.42 mm on each side";
    ASSERT_EQ(foam("approximate arm.urdf --with box -n 1 -o plain.json").code, 0);
    const Outcome converted = foam("convert plain.json arm.urdf --for pybullet -o again.urdf");
    EXPECT_THAT(converted.out, HasSubstr("For PyBullet 3.2.7."));
    EXPECT_THAT(contents(path() / "again.urdf"), HasSubstr("<box size=\"0.2008"));
}

TEST_F(CliEngine, IsAParameterOfTheWriter) {
    ASSERT_EQ(foam("approximate arm.urdf --with box -n 1 -o plain.json").code, 0);
    for (const char* key : {"engine", "outputs.write.urdf.engine"}) {
        ASSERT_EQ(foam(std::string("convert plain.json arm.urdf --force -o out.urdf --set ") + key + "=pybullet").code, 0);
        EXPECT_THAT(contents(path() / "out.urdf"), HasSubstr("<box size=\"0.2008")) << key;
    }
}

TEST_F(CliEngine, ARecipeKeepsTheProgram) {
    EXPECT_THAT(foam("approximate arm.urdf -n 1 --for pybullet --print-recipe").out, HasSubstr("engine: pybullet"));
    EXPECT_THAT(foam("spherize arm.urdf -n 1 --for mujoco --print-recipe").out, HasSubstr("write.mjcf: {file"));
    EXPECT_THAT(foam("spherize arm.urdf -n 1 --for vamp --print-recipe").out, HasSubstr("write.vamp: {file"));
}

TEST_F(CliEngine, GivesWhatTheProgramNeedsBesideShapes) {
    write("two.urdf", "<robot name='two'><link name='a'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
                      "<link name='b'><collision><geometry><box size='1 1 1'/></geometry></collision></link><joint name='j' "
                      "type='fixed'><parent link='a'/><child link='b'/><origin xyz='0 0 1'/></joint></robot>");
    ASSERT_EQ(foam("approximate two.urdf --with box -n 2 --for drake -o drake.urdf").code, 0);
    EXPECT_THAT(contents(path() / "drake.urdf"), HasSubstr("<drake:collision_filter_group"));
    EXPECT_THAT(foam("approximate arm.urdf -n 1 --for vamp --print-recipe").out, HasSubstr("spherize.cover: {"));
    const Outcome other = foam("approximate arm.urdf --with box -n 1 --for pybullet --set outputs.write.urdf.engine=any "
                               "-o any.urdf");
    EXPECT_THAT(other.out, Not(HasSubstr("PyBullet"))) << "the file is for no program";
}

TEST_F(CliEngine, AnElementInPartsOfOthersIsWritten) {
    write("parts.xml", "<mujoco><worldbody><body name='base'><geom type='cylinder' size='0.05 0.2'/><geom size='0.05' "
                       "pos='0 0 0.2'/><geom size='0.05' pos='0 0 -0.2'/></body></worldbody></mujoco>");
    EXPECT_EQ(foam("convert parts.xml arm.urdf -o parts.urdf").code, 0);
    EXPECT_THAT(contents(path() / "parts.urdf"), HasSubstr("<cylinder radius=\"0.05\" length=\"0.4\"/>"));
}

TEST_F(CliEngine, RefusesWhatTheProgramCannotRead) {
    EXPECT_THAT(refusal("approximate arm.urdf --with box -n 1 --for vamp -o out.urdf"),
                HasSubstr("--for vamp: foam writes no boxes for VAMP 0.6.4; remedy: --with sphere; "));
    EXPECT_THAT(refusal("approximate arm.urdf --with hull -n 1 --for physx -o out.urdf"),
                HasSubstr("--for physx: foam writes no hulls for PhysX 5 in SAPIEN 3.0.3; remedy: --with "
                          "sphere,capsule,cylinder,box; "));
    EXPECT_THAT(refusal("approximate arm.urdf --with box,hull -n 1 --for mjx -o out.xml"),
                HasSubstr("takes hulls of at most 20 vertices, which foam makes where they are the only kind"));
    EXPECT_THAT(refusal("approximate arm.urdf -m hulls -n 1 --for physx -o out.urdf"),
                HasSubstr("foam writes spheres, capsules, cylinders and boxes for PhysX"));
    EXPECT_THAT(refusal("spherize arm.urdf -n 1 --for vamp --tool-frame tip -o out.urdf --set guarantee=inner"),
                HasSubstr("which guarantee: inner does not allow"));
    EXPECT_THAT(refusal("spherize arm.urdf -n 1 --for pybullet -o out.json"),
                HasSubstr("--for pybullet: PyBullet 3.2.7 reads no .json; remedy: --format urdf"));
    EXPECT_THAT(refusal("spherize arm.urdf -n 1 --for pibullet -o out.urdf"), HasSubstr("did you mean 'pybullet'?"));
    EXPECT_THAT(refusal("formats --for nobody"), HasSubstr("no engine 'nobody'; there are: "));
    EXPECT_THAT(foam("formats").out, HasSubstr("\npybullet   PyBullet 3.2.7 "));
    EXPECT_THAT(foam("formats --for pybullet").out, HasSubstr("by 1 mm"));
}

} // namespace
} // namespace foam::test
