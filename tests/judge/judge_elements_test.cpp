// The independent judge on elements of all kinds: that it objects where it must, and not to what foam writes.
#include "judge_program.hpp"

#include <functional>
#include <regex>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* pose = "xyz=\"1 -2 0.5\" rpy=\"0.3 -1.2 2\"";

std::string box(double x, double y, double z) {
    return fmt::format("<box size=\"{:.17g} {:.17g} {:.17g}\"/>", x, y, z);
}
std::string round(const char* shape, double radius, double length) {
    return fmt::format("<{} radius=\"{:.17g}\" length=\"{:.17g}\"/>", shape, radius, length);
}
/// A mesh of six quadrilaterals.
std::string box_mesh(double x, double y, double z, const std::string& more = "") {
    std::string text;
    for (int k = 0; k < 8; ++k) {
        text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z);
    }
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n" + more;
}

class JudgeElements : public Judge {
protected:
    void expect(int code, const std::string& model, const std::string& what) const {
        const Outcome verdict = judge("robot.urdf " + model + " --solid 20000");
        EXPECT_EQ(verdict.code, code) << what << '\n' << verdict.out << verdict.err;
    }
    /// That the elements hold the geometry, and not when they are a millionth smaller.
    void expect_least(const std::string& geometry, const std::function<std::string(double)>& elements) const {
        write_urdf("robot.urdf", collision(geometry, pose));
        for (const double share : {1 + 1e-12, 1 - 1e-6}) {
            write_urdf("model.urdf", elements(share));
            expect(share > 1 ? 0 : 1, "model.urdf", elements(share));
        }
    }
};

TEST_F(JudgeElements, KnowsTheLeastElementsAroundABox) {
    const std::string original = box(0.2, 0.3, 0.6);
    const double around = std::hypot(0.1, 0.15);
    expect_least(original, [](double s) { return collision(box(0.2 * s, 0.3 * s, 0.6 * s), pose); });
    expect_least(original, [&](double s) { return collision(round("cylinder", s * around, 0.6), pose); });
    expect_least(original, [&](double s) { return collision(round("cylinder", around * 1.01, 0.6 * s), pose); });
    expect_least(original, [&](double s) { return collision(round("capsule", s * around, 0.6), pose); });
    write("hull.obj", box_mesh(0.05, 0.075, 0.15));
    expect_least(original, [](double s) {
        return collision(fmt::format("<mesh filename=\"hull.obj\" scale=\"2 {:.17g} 2\"/>", 2 * s), pose);
    });
}

TEST_F(JudgeElements, KnowsTheLeastElementsAroundRoundParts) {
    const std::string cylinder = round("cylinder", 0.2, 0.5), capsule = round("capsule", 0.2, 0.5);
    expect_least(cylinder, [](double s) { return collision(round("cylinder", 0.2 * s, 0.5), pose); });
    expect_least(cylinder, [](double s) { return collision(round("cylinder", 0.2, 0.5 * s), pose); });
    expect_least(cylinder, [](double s) { return collision(box(0.4 * s, 0.4, 0.5), pose); });
    expect_least(capsule, [](double s) { return collision(round("capsule", 0.2 * s, 0.5), pose); });
    expect_least(capsule, [](double s) { return collision(round("capsule", 0.2, 0.5 * s), pose); });
    expect_least(capsule, [](double s) { return collision(box(0.4, 0.4, 0.9 * s), pose); });
}

TEST_F(JudgeElements, ReadsAllKindsOfJson) {
    write_urdf("robot.urdf", collision(box(0.2, 0.3, 0.6)));
    for (const char* element :
         {R"("sphere", "position": [0, 0, 0], "radius": 0.35001)",
          R"("capsule", "position": [0, 0, 0], "length": 0.6, "radius": 0.18028)",
          R"("cylinder", "position": [0, 0, 0], "length": 0.6, "radius": 0.18028)",
          R"("box", "position": [0, 0, 0], "size": [0.2, 0.3, 0.6])",
          R"("box", "position": [0, 0, 0], "rotation": [[0, -1, 0], [1, 0, 0], [0, 0, 1]], "size": [0.3, 0.2, 0.6])",
          R"("swept_box", "position": [0, 0, 0], "size": [0.2, 0.3, 0.4], "radius": 0.1)",
          R"("hull", "position": [0, 0, 0], "vertices": [[-0.1, -0.15, -0.3], [0.1, -0.15, -0.3], [0.1, 0.15, -0.3],
             [-0.1, 0.15, -0.3], [-0.1, -0.15, 0.3], [0.1, -0.15, 0.3], [0.1, 0.15, 0.3], [-0.1, 0.15, 0.3]])"}) {
        for (const bool moved : {false, true}) {
            const std::string swept =
                std::regex_replace(element, std::regex("0\\.4\\], \"radius\": 0\\.1"), "0.6], \"radius\": 0.000001");
            write("model.json",
                  R"({"links": {"part": {"spheres": [], "elements": [{"kind": )" +
                      (moved ? std::regex_replace(swept, std::regex("n\": \\[0"), "n\": [0.001") : swept) + "}]}}}");
            expect(moved ? 1 : 0, "model.json", element);
        }
    }
}

TEST_F(JudgeElements, FindsAGapBetweenTwoOfThem) {
    write_urdf("robot.urdf", collision(box(1, 0.7, 0.6)));
    write("left.obj", box_mesh(0.25, 0.35, 0.3));
    write("right.obj", box_mesh(0.2501, 0.3501, 0.3001)); // other diagonals and numbers of the same kind
    for (const double gap : {0.0, 1e-8, 1e-4}) {
        const std::string left = "xyz=\"-0.25 0 0\"", right = fmt::format("xyz=\"{:.17g} 0 0\"", 0.2501 + gap);
        write_urdf("model.urdf", collision(box(0.5, 0.7, 0.6), left) + collision(box(0.5002, 0.7, 0.6), right));
        expect(gap > 0 ? 1 : 0, "model.urdf", fmt::format("boxes, {}", gap));
        write_urdf("model.urdf", collision("<mesh filename=\"left.obj\"/>", left) +
                                     collision("<mesh filename=\"right.obj\"/>", right));
        expect(gap > 0 ? 1 : 0, "model.urdf", fmt::format("hulls, {}", gap));
        write_urdf("model.urdf",
                   collision(box(0.5, 0.7, 0.6), left) +
                       collision(round("cylinder", 0.5, 0.5002), right + " rpy=\"0 1.5707963267948966 0\""));
        expect(gap > 0 ? 1 : 0, "model.urdf", fmt::format("a box and a cylinder, {}", gap));
    }
}

TEST_F(JudgeElements, RefusesAMeshThatIsNoConvexBody) {
    write_urdf("robot.urdf", collision(box(0.1, 0.1, 0.1)));
    write_urdf("model.urdf", collision("<mesh filename=\"hull.obj\"/>"));
    write("hull.obj", box_mesh(1, 1, 1,
                               "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\n"
                               "f 9 11 10\nf 9 12 11\nf 9 10 12\nf 10 11 12\n"));
    EXPECT_THAT(judge("robot.urdf model.urdf").err, HasSubstr("judge: hull.obj: it is not convex"));
    write("hull.obj", std::regex_replace(box_mesh(1, 1, 1), std::regex("f 2 4 8 6\n"), ""));
    EXPECT_THAT(judge("robot.urdf model.urdf").err, HasSubstr("judge: hull.obj: it is not closed"));
    write("hull.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
    EXPECT_THAT(judge("robot.urdf model.urdf").err,
                HasSubstr("judge: hull.obj: the vertices of a hull lie in a plane"));
}

TEST_F(JudgeElements, MeasuresTheVolumeThatElementsLeave) {
    // Slabs on all sides of a cube, a quarter of its edge thick: what they leave is a cube of half its edge.
    write("cube.obj", box_mesh(0.5, 0.5, 0.5));
    write_urdf("robot.urdf", collision("<mesh filename=\"cube.obj\"/>"));
    std::string slabs;
    for (const char* side : {"0.375 0 0", "-0.375 0 0"}) {
        slabs += collision(box(0.25, 1, 1), fmt::format("xyz=\"{}\"", side));
        slabs += collision(box(0.25, 1, 1), fmt::format("xyz=\"0 {}\" rpy=\"0 0 1.5707963267948966\"",
                                                        std::string(side).substr(0, std::string(side).rfind(' '))));
        slabs += collision(box(1.0001, 1.0001, 0.25),
                           fmt::format("xyz=\"0 0 {}\"", std::string(side).substr(0, std::string(side).find(' '))));
    }
    write_urdf("model.urdf", slabs);
    for (const char* original : {"<mesh filename=\"cube.obj\"/>", "<box size=\"1 1 1\"/>"}) {
        write_urdf("robot.urdf", collision(original));
        const Outcome verdict = judge("robot.urdf model.urdf --volume 1000000");
        std::smatch found;
        ASSERT_TRUE(std::regex_search(verdict.out, found,
                                      std::regex("link 'part': ([0-9.e-]+) of its volume lies outside all elements")))
            << verdict.out << verdict.err;
        EXPECT_NEAR(std::stod(found[1]), 0.125, 1e-3);
        EXPECT_THAT(judge("robot.urdf model.urdf").out, Not(HasSubstr("by 0.2"))) << "the surface is held";
        const Outcome solid = judge("robot.urdf model.urdf --solid 10000");
        EXPECT_EQ(solid.code, 1);
        EXPECT_THAT(solid.out, HasSubstr("of the geometry lies outside all elements by 0.2"));
        EXPECT_THAT(solid.out, HasSubstr("1 of them as solids"));
    }
}

/// Links of every primitive, and of a mesh that is not convex, at poses of all kinds.
constexpr const char* small_robot = R"(<robot name="small">
<link name="plate"><collision><origin xyz="0.1 0.2 -0.3" rpy="0.4 -0.5 0.6"/>
  <geometry><box size="0.3 0.2 0.05"/></geometry></collision></link>
<link name="wheel"><collision><origin rpy="1.5707963267948966 0 0"/>
  <geometry><cylinder radius="0.1" length="0.06"/></geometry></collision></link>
<link name="knob"><collision><origin xyz="0 0 0.1"/><geometry><sphere radius="0.04"/></geometry></collision>
  <collision><origin xyz="0 0 0.2" rpy="0 0.3 0"/><geometry><box size="0.1 0.05 0.15"/></geometry></collision></link>
<link name="bracket"><collision><origin xyz="-3 0 0.1" rpy="0 1 2"/>
  <geometry><mesh filename="bracket.obj" scale="0.001 0.001 0.001"/></geometry></collision></link>
<joint name="a" type="fixed"><parent link="plate"/><child link="wheel"/></joint>
<joint name="b" type="fixed"><parent link="wheel"/><child link="knob"/></joint>
<joint name="c" type="fixed"><parent link="knob"/><child link="bracket"/></joint>
</robot>)";
/// An L, in millimetres.
constexpr const char* bracket = "v 0 0 0\nv 200 0 0\nv 200 50 0\nv 50 50 0\nv 50 150 0\nv 0 150 0\n"
                                "v 0 0 60\nv 200 0 60\nv 200 50 60\nv 50 50 60\nv 50 150 60\nv 0 150 60\n"
                                "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\n"
                                "f 5 6 12 11\nf 6 1 7 12\n";

struct Written {
    const char* name;
    const char* options; ///< of foam approximate
    const char* file;
    bool turned = false; ///< whether an orientation of its file is changed as well
};
void PrintTo(const Written& written, std::ostream* stream) {
    *stream << written.name;
}

class JudgeWritten : public JudgeElements, public testing::WithParamInterface<Written> {
protected:
    void SetUp() override {
        write("robot.urdf", small_robot);
        write("bracket.obj", bracket);
        const Outcome made = foam(fmt::format("approximate robot.urdf -n 5 {} -o {}", GetParam().options, file()));
        ASSERT_EQ(made.code, 0) << made.err;
        text_ = contents(path() / file());
        expect(0, file(), GetParam().name);
    }
    std::string file() const { return GetParam().file; }
    bool is_json() const { return file().ends_with(".json"); }

    struct Spot {
        std::size_t begin, end;
    };
    /// What stands between the two texts, each time. Of JSON only elements of the finest level: they are on lines of
    /// their own, those of the trees farther in.
    std::vector<Spot> between(const std::string& before, const std::string& after) const {
        std::vector<Spot> spots;
        for (std::size_t at = text_.find(before); at != text_.npos; at = text_.find(before, at + 1)) {
            const std::size_t begin = at + before.size(), line = text_.rfind('\n', at) + 1;
            if (!is_json() || text_.compare(line, 10, "        {\"") == 0) {
                spots.push_back({begin, text_.find(after, begin)});
            }
        }
        return spots;
    }
    /// That the judge objects whenever another text is at one of the spots.
    void expect_objections(const std::vector<Spot>& spots,
                           const std::function<std::string(const std::string&)>& other) const {
        EXPECT_GE(spots.size(), 4u);
        for (const auto& [begin, end] : spots) {
            const std::string found = text_.substr(begin, end - begin);
            write("spoiled_" + file(), text_.substr(0, begin) + other(found) + text_.substr(end));
            expect(1, "spoiled_" + file(), found + " became " + other(found));
        }
    }
    static std::string times(const std::string& text, double factor) {
        std::string result;
        for (const char* word = text.c_str(); *word != '\0';) {
            char* end = nullptr;
            const double value = std::isspace(static_cast<unsigned char>(*word)) ? 0 : std::strtod(word, &end);
            const bool is_number = end != nullptr && end != word;
            result += is_number ? fmt::format("{:.17g}", factor * value) : std::string(1, *word);
            word = is_number ? end : word + 1;
        }
        return result;
    }

    void expect_objections_to_a_smaller_element() const;
    void expect_objections_to_an_element_moved_by_two_millimetres() const;
    void expect_objections_to_a_missing_element() const;
    void expect_an_objection_to_an_element_of_the_plate_that_is_turned() const;

    std::string text_;
};

void JudgeWritten::expect_objections_to_a_smaller_element() const {
    const auto smaller = [](const std::string& numbers) { return times(numbers, 0.99); };
    const std::string kind = GetParam().name;
    if (kind.ends_with("mesh")) {
        expect_objections(between("<mesh filename=\"small_hulls", "/>"),
                          [](const std::string& reference) { return reference + " scale=\"0.99 0.99 0.99\""; });
    } else if (is_json()) {
        expect_objections(kind == "hull"           ? between("\"vertices\": [", "}")
                          : kind == "capsule_json" ? between("\"radius\": ", "}")
                                                   : between("\"size\": [", "]"),
                          smaller);
    } else {
        expect_objections(kind.ends_with("box") ? between("<box size=\"", "\"")
                          : kind == "capsule"   ? between("<capsule radius=\"", "\"")
                                                : between("<cylinder radius=\"", "\""),
                          smaller);
    }
}

void JudgeWritten::expect_objections_to_an_element_moved_by_two_millimetres() const {
    expect_objections(between(is_json() ? "\"position\": [" : "<collision><origin xyz=\"", is_json() ? "," : " "),
                      [](const std::string& x) { return fmt::format("{:.17g}", std::stod(x) + 0.002); });
}

void JudgeWritten::expect_objections_to_a_missing_element() const {
    if (is_json()) { // far away, so that the lists keep their commas
        expect_objections(between("\"position\": [", "]"), [](const std::string&) { return "9, 9, 9"; });
        return;
    }
    std::vector<Spot> spots = between("<collision>", "</collision>");
    for (Spot& spot : spots) {
        spot = {spot.begin - std::string("<collision>").size(), spot.end + std::string("</collision>").size()};
    }
    expect_objections(spots, [](const std::string&) { return ""; });
}

// Lines through the edges of a box's triangles: points above them were taken to be inside.
TEST_F(JudgeElements, PointsBeyondAnEdgeAreOutside) {
    const std::string upper = collision(box(0.717, 0.497, 0.0845), "xyz=\"0 0 0.18925\""),
                      lower = collision(box(0.705, 0.48, 0.167), "xyz=\"0 0 0.0335\"");
    write_urdf("robot.urdf", upper + collision(box(0.58, 0.39, 0.03), "xyz=\"0 0 0.132\"") + lower);
    write_urdf("model.urdf", collision(box(0.717002, 0.497002, 0.114502), "xyz=\"0 0 0.17425\"") +
                                 collision(box(0.705002, 0.480002, 0.167002), "xyz=\"0 0 0.0335\""));
    for (const char* points : {"100000", "200000"}) {
        const Outcome verdict = judge(std::string("robot.urdf model.urdf --solid ") + points);
        EXPECT_EQ(verdict.code, 0) << verdict.out;
    }
}

TEST_F(JudgeElements, HasNoObjectionToCapsulesInParts) {
    write("robot.urdf", small_robot);
    write("bracket.obj", bracket);
    const Outcome made = foam("approximate robot.urdf -n 8 --with capsule -o small.urdf");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(contents(path() / "small.urdf"), HasSubstr("<cylinder"));
    expect(0, "small.urdf", "parts");
}

void JudgeWritten::expect_an_objection_to_an_element_of_the_plate_that_is_turned() const {
    const Spot roll = between("rpy=\"", " ").at(0); // of the first link
    const std::string found = text_.substr(roll.begin, roll.end - roll.begin);
    write("spoiled_" + file(),
          text_.substr(0, roll.begin) + fmt::format("{:.17g}", std::stod(found) + 0.01) + text_.substr(roll.end));
    expect(1, "spoiled_" + file(), found);
}

// One test a kind: all change the same model, which takes longer to make than to judge.
TEST_P(JudgeWritten, ObjectsToAnElementThatIsSmallerMovedMissingOrTurned) {
    expect_objections_to_a_smaller_element();
    expect_objections_to_an_element_moved_by_two_millimetres();
    expect_objections_to_a_missing_element();
    if (GetParam().turned) {
        expect_an_objection_to_an_element_of_the_plate_that_is_turned();
    }
}

std::string name_of_written(const testing::TestParamInfo<Written>& info) {
    return info.param.name;
}

constexpr const char* capsules_as_elements = "--with capsule --set outputs.write.urdf.capsules=element";

INSTANTIATE_TEST_SUITE_P(Kinds, JudgeWritten,
                         testing::Values(Written{"box", "--with box", "small.urdf", true},
                                         Written{"box_json", "--with box", "small.json"},
                                         Written{"cylinder", "--with cylinder", "small.urdf", true},
                                         Written{"capsule", capsules_as_elements, "small.urdf", true},
                                         Written{"capsule_json", "--with capsule", "small.json"},
                                         Written{"swept_box", "--with swept_box", "small.json"},
                                         Written{"swept_box_as_box", "--with swept_box", "small.urdf"},
                                         Written{"hull", "--with hull", "small.json"},
                                         Written{"hull_mesh", "--with hull", "small.urdf", true}),
                         name_of_written);

/// Robots of others.
class JudgeSharedElements : public Judge, public testing::WithParamInterface<const char*> {
protected:
    void SetUp() override {
        if (!std::filesystem::is_directory(shared_folder())) {
            GTEST_SKIP() << "no robots and meshes of others: FOAM_SHARED leads nowhere";
        }
    }
};

TEST_P(JudgeSharedElements, HasNoObjection) {
    const std::string kind = GetParam(), ending = kind == "swept_box" ? "json" : "urdf";
    const std::string robot =
        (shared_folder() / "robots/ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf").string();
    const Outcome made = foam(fmt::format("approximate '{}' -n 16 --with {} -o model.{}", robot, kind, ending));
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome verdict = judge(fmt::format("'{}' model.{} --solid 200000", robot, ending));
    EXPECT_EQ(verdict.code, 0) << verdict.out << verdict.err;
}

std::string name_of_kind(const testing::TestParamInfo<const char*>& info) {
    const std::string kind = info.param;
    return kind.find(',') == std::string::npos ? kind : "mixed";
}

INSTANTIATE_TEST_SUITE_P(Ur5, JudgeSharedElements,
                         testing::Values("capsule", "cylinder", "box", "swept_box", "hull",
                                         "sphere,capsule,cylinder,box,hull"),
                         name_of_kind);

} // namespace
} // namespace foam::test
