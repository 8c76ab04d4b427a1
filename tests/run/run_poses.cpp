// Runs whose budget serves random poses: links whose spheres touch though their geometry does not get more of it.
#include "small_robot.hpp"
#include "support/read_spheres.hpp"

namespace foam {
namespace {

using ::testing::Contains;
using ::testing::MatchesRegex;

/// A plate that a joint moves over another one, at least 1 cm above it, and a large block far away.
constexpr const char* two_plates = R"(<?xml version="1.0"?>
<robot name="plates">
  <link name="table"><collision><geometry><box size="0.6 0.6 0.04"/></geometry></collision></link>
  <link name="block"><collision><geometry><box size="1 1 0.6"/></geometry></collision></link>
  <link name="arm"><collision><origin xyz="1 0 0"/><geometry><box size="0.01 0.01 0.01"/></geometry></collision></link>
  <link name="tool"><collision><geometry><box size="0.3 0.3 0.04"/></geometry></collision></link>
  <joint name="fixed" type="fixed"><origin xyz="-3 0 0"/><parent link="table"/><child link="block"/></joint>
  <joint name="turn" type="continuous">
    <origin xyz="0 0 0.7"/><axis xyz="0 0 1"/><parent link="table"/><child link="arm"/>
  </joint>
  <joint name="slide" type="prismatic">
    <origin xyz="0 0 -0.7"/><axis xyz="0 0 1"/><limit lower="0.05" upper="0.35" effort="1" velocity="1"/>
    <parent link="arm"/><child link="tool"/>
  </joint>
</robot>
)";

class PosesOfPlates : public Run {
protected:
    PosesOfPlates() { write("two.urdf", two_plates); }

    RunResult made(const std::string& budget, std::size_t threads = 1) {
        RunOptions with = options();
        with.threads = threads;
        return run(recipe("stages: [spherize.grid]\nbudget: {" + budget + "}\n"), registry, with);
    }
    std::string written() const { return read_file(folder.path() / "out/two.urdf"); }
    /// In how many of 301 heights the spheres of the two plates touch; the plates never do.
    int heights_in_contact() const {
        const auto spheres = test::read_spheres(*registry.make<Writer>("write.urdf"), written());
        int touching = 0;
        for (int i = 0; i <= 300; ++i) {
            const Vec3 above{0, 0, 0.05 + 0.001 * i};
            bool touch = false;
            for (const Sphere& a : spheres.at("table")) {
                for (const Sphere& b : spheres.at("tool")) {
                    touch = touch || distance(a.center, b.center + above) < a.radius + b.radius;
                }
            }
            touching += touch ? 1 : 0;
        }
        return touching;
    }
};

std::vector<std::string> notes_of(const RunResult& result) {
    std::vector<std::string> notes;
    for (const Finding& finding : result.findings) {
        if (finding.severity == Severity::info) {
            notes.push_back(finding.message);
        }
    }
    return notes;
}

TEST_F(PosesOfPlates, FewerSpheresTouchWrongly) {
    made("spheres: 60");
    const int before = heights_in_contact();
    const RunResult result = made("spheres: 60, for: poses");
    EXPECT_LT(heights_in_contact(), 0.7 * before);
    EXPECT_TRUE(result.certified);
    EXPECT_LE(result.total.spheres, 60u);
    EXPECT_THAT(notes_of(result),
                Contains(MatchesRegex("budget\\.for: poses: [0-9]+ false contacts of links in 500 random poses, "
                                      "[0-9]+ by volume alone")));
}

TEST_F(PosesOfPlates, ThreadsDoNotChangeTheResult) {
    made("spheres: 40, for: poses", 1);
    const std::string one = written();
    made("spheres: 40, for: poses", 3);
    EXPECT_EQ(written(), one);
}

TEST_F(PosesOfPlates, GeometryIsTheDefault) {
    const RunResult result = made("spheres: 40");
    EXPECT_THAT(notes_of(result), ::testing::Not(Contains(::testing::HasSubstr("budget.for"))));
    const std::string by_default = written();
    made("spheres: 40, for: geometry");
    EXPECT_EQ(written(), by_default);
}

TEST_F(PosesOfPlates, WithoutFalseContactsNothingChanges) {
    std::string apart = two_plates;
    apart.replace(apart.find("lower=\"0.05\" upper=\"0.35\""), 25, "lower=\"9.05\" upper=\"9.35\"");
    write("two.urdf", apart);
    made("spheres: 20");
    const std::string by_volume = written();
    made("spheres: 20, for: poses");
    EXPECT_EQ(written(), by_volume);
}

TEST_F(PosesOfPlates, ContactsOfKeptSpheresAloneChangeNothing) {
    const std::string links = "\nlinks: {table: {keep: [[0, 0, 0, 0.45]]}, tool: {keep: [[0, 0, 0, 0.25]]}}";
    const auto with_kept = [&](const std::string& budget) {
        return run(recipe("stages: [spherize.grid]\nbudget: {" + budget + "}" + links + "\n"), registry, options());
    };
    with_kept("spheres: 20");
    const std::string by_volume = written();
    const RunResult result = with_kept("spheres: 20, for: poses");
    EXPECT_EQ(written(), by_volume);
    EXPECT_THAT(notes_of(result), Contains(MatchesRegex("budget\\.for: poses: ([1-9][0-9]*) false contacts .*")));
}

TEST_F(PosesOfPlates, ATimeLimitEndsTheRounds) {
    const RunResult result = made("spheres: 300, for: poses, time_limit: 0.2");
    EXPECT_TRUE(result.certified);
    EXPECT_LE(result.total.spheres, 300u);
}

} // namespace
} // namespace foam
