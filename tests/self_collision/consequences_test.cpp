// What a model does in poses, of a robot whose answer is known: a slider along x that brings two boxes together.
#include "cli/program.hpp"

#include <foam/base/error.hpp>
#include <foam/collision/consequences.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/inscribed_mesh.hpp>

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// The tip is at x = 1 - q for q in [0, 1]; two moving joints, so that the links are no neighbours.
std::string slider(const std::string& base, const std::string& tip) {
    return "<robot name=\"slider\"><link name=\"base\"><collision><geometry>" + base +
           "</geometry></collision></link><link name=\"between\"/><link name=\"tip\"><collision><geometry>" + tip +
           "</geometry></collision></link>"
           "<joint name=\"x\" type=\"prismatic\"><parent link=\"base\"/><child link=\"between\"/>"
           "<origin xyz=\"1 0 0\"/><axis xyz=\"-1 0 0\"/><limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"
           "</joint><joint name=\"turn\" type=\"revolute\"><parent link=\"between\"/><child link=\"tip\"/>"
           "<axis xyz=\"1 0 0\"/><limit lower=\"0\" upper=\"0\" effort=\"1\" velocity=\"1\"/></joint></robot>";
}

class Poses : public Cli {
protected:
    Poses() {
        const std::string box = "<box size=\"0.2 0.2 0.2\"/>";
        write("slider.urdf", slider(box, box));
        write("large.csv", "link,x,y,z,radius\nbase,0,0,0,0.3\ntip,0,0,0,0.3\n");
        write("small.csv", "link,x,y,z,radius\nbase,0,0,0,0.05\ntip,0,0,0,0.05\n");
    }
    json judged(const std::string& arguments) {
        const Outcome outcome = foam("evaluate " + arguments + " --json");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.code == 0 ? json::parse(outcome.out).at("consequences") : json();
    }
};

TEST_F(Poses, CountsContactsThatAreKnown) {
    // The boxes touch for q >= 0.8, spheres of radius 0.3 for q >= 0.4.
    const json found = judged("slider.urdf large.csv --poses 20000");
    EXPECT_EQ(found["poses"], 20000);
    EXPECT_NEAR(found["in_contact"].get<double>() / 20000, 0.2, 0.01);
    EXPECT_NEAR(found["refused"].get<double>() / 20000, 0.6, 0.01);
    EXPECT_EQ(found["falsely_refused"].get<int>(), found["refused"].get<int>() - found["in_contact"].get<int>());
    EXPECT_EQ(found["missed"], 0);
    ASSERT_EQ(found["pairs"].size(), 1u);
    EXPECT_EQ(found["pairs"][0]["false_contacts"], found["falsely_refused"]);
    ASSERT_EQ(found["elements"].size(), 2u);
    EXPECT_EQ(found["elements"][0]["false_contacts"], found["falsely_refused"]);
}

TEST_F(Poses, CountsContactsThatAModelMisses) {
    const json found = judged("slider.urdf small.csv --poses 20000"); // the spheres touch for q >= 0.9
    EXPECT_NEAR(found["missed"].get<double>() / 20000, 0.1, 0.01);
    EXPECT_EQ(found["falsely_refused"], 0);
    EXPECT_EQ(found["elements"].size(), 0u);
}

TEST_F(Poses, OfAFileAreTakenAsTheyAre) {
    write("poses.yaml", "- {x: 0.5}\n- {x: 0.9}\n- {}\n");
    const json found = judged("slider.urdf large.csv --pose-file poses.yaml");
    EXPECT_EQ(found["poses"], 3);
    EXPECT_EQ(found["in_contact"], 1);
    EXPECT_EQ(found["refused"], 2);
    const Outcome outcome = foam("evaluate slider.urdf large.csv --pose-file poses.yaml");
    EXPECT_THAT(outcome.out, HasSubstr("3 poses, 1 pair of links"));
    EXPECT_THAT(outcome.out, HasSubstr("falsely refused          1   33.33 %"));
}

TEST_F(Poses, APieceInsideAnotherTouches) {
    write("slider.urdf", slider("<box size=\"1 1 1\"/>", "<sphere radius=\"0.01\"/>"));
    write("whole.csv", "link,x,y,z,radius\nbase,0,0,0,0.9\ntip,0,0,0,0.011\n");
    const json found = judged("slider.urdf whole.csv --poses 20000");
    EXPECT_NEAR(found["in_contact"].get<double>() / 20000, 0.51, 0.01);
    EXPECT_EQ(found["missed"], 0);
}

TEST_F(Poses, PairsOfAFileAreLeftOut) {
    write("slider.srdf",
          "<robot name=\"slider\"><disable_collisions link1=\"tip\" link2=\"base\" reason=\"Never\"/></robot>");
    const Outcome outcome = foam("evaluate slider.urdf large.csv --poses 10 --srdf slider.srdf");
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("no pair of links is left to check"));
    EXPECT_THAT(foam("evaluate slider.urdf large.csv --srdf slider.srdf").err, HasSubstr("remedy: --poses"));
}

TEST_F(Poses, OfABadFileAreRefused) {
    const auto refused = [&](const std::string& text) {
        write("poses.yaml", text);
        const Outcome outcome = foam("evaluate slider.urdf large.csv --pose-file poses.yaml");
        EXPECT_NE(outcome.code, 0);
        return outcome.err;
    };
    EXPECT_THAT(refused("{x: 1}\n"), HasSubstr("poses.yaml:1:1: expected a list of poses"));
    EXPECT_THAT(refused("- [1]\n"), HasSubstr("expected a map from joints to positions, got a list"));
    EXPECT_THAT(refused("- {x: near}\n"), HasSubstr("expected a number of rad or m"));
    EXPECT_THAT(refused("- {x: 0}\n- {elbow: 1}\n"), HasSubstr("pose 2: "));
    EXPECT_THAT(refused("[]\n"), HasSubstr("expected a list of poses"));
}

TEST(InscribedMesh, LiesInTheElement) {
    const Pose pose = Pose::from_xyz_rpy({1, 2, 3}, {0.1, 0.2, 0.3});
    for (const Element& primitive :
         {Element::sphere(0.5), Element::capsule(0.5, 1), Element::cylinder(0.5, 1), Element::box({1, 2, 3}),
          Element::ellipsoid({1, 2, 3})}) {
        const Element element = moved(primitive, pose);
        const Mesh mesh = inscribed_mesh(element, 96);
        EXPECT_TRUE(topology(mesh).closed());
        for (const Vec3& p : mesh.vertices) {
            EXPECT_LE(distance(element, p), 1e-12);
        }
        EXPECT_LE(signed_volume(mesh), volume(element) * (1 + 1e-9));
        EXPECT_GE(signed_volume(mesh), volume(element) * 0.995);
    }
}

} // namespace
} // namespace foam::test
