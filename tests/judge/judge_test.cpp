// The independent judge: that it objects where it must, and that it does not object to what foam writes.
#include "judge_program.hpp"

#include <regex>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

class JudgeBalls : public Judge {
protected:
    /// That a ball of this radius holds the geometry, and one of a thousandth less does not.
    void expect_least(const std::string& geometry, const std::string& center, double radius) const {
        write_urdf("robot.urdf", geometry);
        write_urdf("spheres.urdf", ball(radius * (1 + 1e-12), center));
        const Outcome holds = judge("robot.urdf spheres.urdf");
        EXPECT_EQ(holds.code, 0) << holds.out << holds.err;
        write_urdf("spheres.urdf", ball(radius * 0.999, center));
        const Outcome fails = judge("robot.urdf spheres.urdf");
        EXPECT_EQ(fails.code, 1) << fails.out << fails.err;
        EXPECT_THAT(fails.out, HasSubstr("link 'part': the point ["));
    }
    /// `foam spherize` with these options, fast; then the judge's verdict on the written file.
    void expect_kept(const std::string& input, const std::string& guarantee, const std::string& options,
                     const std::string& without = "") const {
        const Outcome made = foam(fmt::format("spherize '{}' -o spheres.{} --fresh --set guarantee={} "
                                              "--set stages.spherize.cover.effort=fast {}",
                                              input, input.ends_with(".urdf") ? "urdf" : "csv", guarantee, options));
        ASSERT_TRUE(made.code == 0 || made.code == 4) << made.err;
        const Outcome verdict = judge(
            fmt::format("'{}' spheres.{} {} {}", input, input.ends_with(".urdf") ? "urdf" : "csv", guarantee, without));
        EXPECT_EQ(verdict.code, 0) << verdict.out << verdict.err;
    }
};

TEST_F(JudgeBalls, KnowsTheLeastBallAroundAPart) {
    expect_least(collision("<box size=\"0.6 0.2 0.3\"/>", "xyz=\"1 2 3\" rpy=\"0.3 -1.2 2\""), "1 2 3", 0.35);
    expect_least(collision("<sphere radius=\"0.25\"/>", "xyz=\"-1 0 0\""), "-1 0 0", 0.25);
    expect_least(collision("<capsule radius=\"0.1\" length=\"0.4\"/>", "xyz=\"0 1 0\" rpy=\"1 1 1\""), "0 1 0", 0.3);
    // A cylinder along x after a quarter turn about y: half its length is 0.4, its radius 0.3.
    expect_least(collision("<cylinder radius=\"0.3\" length=\"0.8\"/>", "rpy=\"0 1.5707963267948966 0\""), "0 0 0",
                 0.5);
}

TEST_F(JudgeBalls, FindsWhatTwoBallsLeaveBetweenThem) {
    // Two balls over the ends of a bar of 1 x 0.6 x 0.6: its section in the middle has a corner 0.3 √2 from the axis.
    write_urdf("robot.urdf", collision("<box size=\"1 0.6 0.6\"/>"));
    const double least = std::sqrt(0.25 * 0.25 + 2 * 0.3 * 0.3);
    for (const double share : {1 + 1e-12, 1 - 1e-6}) {
        write_urdf("spheres.urdf", ball(share * least, "-0.25 0 0") + ball(share * least, "0.25 0 0"));
        const Outcome verdict = judge("robot.urdf spheres.urdf");
        EXPECT_EQ(verdict.code, share > 1 ? 0 : 1) << verdict.out << verdict.err;
    }
}

TEST_F(JudgeBalls, KnowsTheLargestBallInAPart) {
    write_urdf("robot.urdf", collision("<box size=\"0.6 0.2 0.3\"/>", "xyz=\"1 2 3\" rpy=\"0.3 -1.2 2\""));
    for (const auto& [radius, code] : {std::pair(0.1 - 1e-12, 0), std::pair(0.1001, 1), std::pair(2.0, 1)}) {
        write_urdf("spheres.urdf", ball(radius, "1 2 3"));
        EXPECT_EQ(judge("robot.urdf spheres.urdf inner").code, code) << radius;
    }
}

TEST_F(JudgeBalls, SeesThatACavityIsOutside) {
    const auto shell = [](double half, bool inwards, int first) {
        std::string text;
        for (int k = 0; k < 8; ++k) {
            text += fmt::format("v {} {} {}\n", k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half);
        }
        constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        for (const auto& f : faces) {
            text += fmt::format("f {} {} {} {}\n", f[0] + first, f[inwards ? 3 : 1] + first, f[2] + first,
                                f[inwards ? 1 : 3] + first);
        }
        return text;
    };
    write("hollow.obj", shell(1, false, 1) + shell(0.5, true, 9));
    write("spheres.csv", "link,x,y,z,radius\nhollow,0,0,0,0.3\n");
    const Outcome cavity = judge("hollow.obj spheres.csv inner");
    EXPECT_EQ(cavity.code, 1) << cavity.out;
    EXPECT_THAT(cavity.out, HasSubstr("of a sphere lies outside the geometry by "));
    write("spheres.csv", "link,x,y,z,radius\nhollow,0.75,0,0,0.249\n");
    EXPECT_EQ(judge("hollow.obj spheres.csv inner").code, 0);
}

TEST_F(JudgeBalls, NamesALinkWithoutElements) {
    write_urdf("robot.urdf", collision("<box size=\"1 1 1\"/>"));
    write("spheres.csv", "link,x,y,z,radius\nother,0,0,0,3\n");
    const Outcome verdict = judge("robot.urdf spheres.csv");
    EXPECT_EQ(verdict.code, 2) << "nothing was judged";
    EXPECT_THAT(verdict.out, HasSubstr("link 'part': it has no elements"));
}

struct Given {
    const char *file, *lost = ""; ///< what has no room for a sphere inside
    const char* options = "-n 45";
};
void PrintTo(const Given& given, std::ostream* stream) {
    *stream << given.file;
}
std::string name_of(const testing::TestParamInfo<Given>& info) {
    return std::regex_replace(std::filesystem::path(info.param.file).filename().string(), std::regex("[^A-Za-z0-9]"),
                              "_") +
           "_" + std::to_string(info.index);
}

class JudgeShared : public JudgeBalls, public testing::WithParamInterface<Given> {
protected:
    void SetUp() override {
        if (!std::filesystem::is_directory(shared_folder())) {
            GTEST_SKIP() << "no robots and meshes of others: FOAM_SHARED leads nowhere";
        }
    }
    std::string file() const { return (shared_folder() / GetParam().file).string(); }
};

TEST_P(JudgeShared, HasNoObjection) {
    expect_kept(file(), "outer", GetParam().options);
    expect_kept(file(), "inner", GetParam().options, GetParam().lost);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, JudgeShared,
    testing::Values(
        Given{"robots/panda/moveit_resources_panda_description/urdf/panda.urdf"},
        Given{"robots/panda/foam_variant/panda.urdf"}, Given{"robots/jaco/kinova_description/urdf/j2s7s300.urdf"},
        Given{"robots/baxter/example-robot-data/robots/baxter_description/urdf/baxter.urdf"},
        Given{"robots/baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf"},
        Given{"robots/iiwa/model.urdf"},
        Given{"robots/ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf"},
        Given{"robots/fetch/fetch_description/fetch_foam.urdf"},
        Given{"robots/fetch/fetch_description/robots/fetch.urdf"},
        Given{"robots/stretch/foam_variant/stretch/stretch.urdf",
              "--without link_aruco_right_base --without link_aruco_left_base", "-n 45 --set on_error=skip"},
        Given{"robots/stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
              "--without link_aruco_right_base --without link_aruco_left_base", "-n 45 --set on_error=skip"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Meshes, JudgeShared,
    testing::Values(Given{"meshes/real/fandisk.obj", "", "-n 12"}, Given{"meshes/real/rocker-arm.obj", "", "-n 12"},
                    Given{"meshes/real/spot.obj", "", "-n 12"}, Given{"meshes/real/suzanne.obj", "", "-n 12"},
                    Given{"meshes/real/teapot.obj", "", "-n 12"}, Given{"meshes/real/plate_holes.STL", "", "-n 12"},
                    Given{"meshes/real/1002_tray_bottom.STL", "", "-n 12"},
                    Given{"meshes/real/featuretype.STL", "", "-n 12"},
                    Given{"meshes/real/Spider_ascii.stl", "", "-n 12"}, Given{"meshes/real/duck.dae", "", "-n 12"},
                    Given{"meshes/synthetic/nested_shells_cavity.stl", "", "-n 12"},
                    Given{"meshes/synthetic/overlapping_parts.obj", "", "-n 12"},
                    Given{"meshes/synthetic/star_ngon_concave.obj", "", "-n 12"},
                    Given{"meshes/synthetic/far_from_origin.obj", "", "-n 12"},
                    Given{"meshes/synthetic/tiny_1e-6.stl", "", "-n 12"},
                    Given{"meshes/synthetic/mm_y_up_instances.dae", "", "-n 12"}),
    name_of);

/// Every sphere of a cover is needed to a thousandth of its radius, and the judge sees each that is not there.
class JudgeSpoiled : public Judge {
protected:
    void SetUp() override {
        robot = std::filesystem::path(FOAM_TEST_SOURCE) / "configs/robots/panda/panda.urdf";
        ASSERT_EQ(foam(fmt::format("spherize '{}' -n 16 -o spheres.urdf --fresh", robot.string())).code, 0);
        text = contents(path() / "spheres.urdf");
        ASSERT_EQ(judge(fmt::format("'{}' spheres.urdf", robot.string())).code, 0);
    }
    /// With what the expression finds for the n-th time replaced.
    std::vector<std::string> spoiled(const std::string& expression,
                                     const std::function<std::string(double)>& other) const {
        std::vector<std::string> texts;
        const std::regex regex(expression);
        for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
            std::string changed = text;
            changed.replace(static_cast<std::size_t>(it->position(1)), static_cast<std::size_t>(it->length(1)),
                            other(std::stod(it->str(1))));
            texts.push_back(changed);
        }
        return texts;
    }
    void expect_objections(const std::vector<std::string>& texts) const {
        ASSERT_GE(texts.size(), 10u);
        for (const std::string& changed : texts) {
            write("spoiled.urdf", changed);
            const Outcome verdict = judge(fmt::format("'{}' spoiled.urdf", robot.string()));
            EXPECT_EQ(verdict.code, 1) << verdict.out << verdict.err;
            EXPECT_THAT(verdict.out,
                        testing::ContainsRegex("link 'panda_[a-z0-9]+': the point .* of the geometry lies outside "
                                               "all elements by [0-9.e-]+ m"));
        }
    }

    std::filesystem::path robot;
    std::string text;
};

TEST_F(JudgeSpoiled, ObjectsToARadiusThatIsAThousandthSmaller) {
    expect_objections(
        spoiled("<sphere radius=\"([^\"]*)\"", [](double r) { return fmt::format("{:.17g}", 0.999 * r); }));
}

TEST_F(JudgeSpoiled, ObjectsToASphereThatIsMovedByAMillimetre) {
    expect_objections(spoiled("<origin xyz=\"([-0-9.e]+) [^\"]*\" rpy=\"0 0 0\"/><geometry><sphere",
                              [](double x) { return fmt::format("{:.17g}", x + 0.001); }));
}

} // namespace
} // namespace foam::test
