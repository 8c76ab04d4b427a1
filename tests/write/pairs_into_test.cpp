// `pairs: keep | merge | replace` in files of the user, for every writer that lists pairs and edits files.
#include "models.hpp"

#include <foam/sdk/stage.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Told : QuietContext {
    void log(Severity severity, std::string_view text) override {
        (severity >= Severity::warning ? warnings : notes).emplace_back(text);
    }
    std::vector<std::string> warnings, notes;
};

SphereModel model_into(const std::string& text) {
    SphereModel model;
    model.robot = chain_of({"a", "b", "c", "d"});
    model.name = "test";
    for (const char* link : {"a", "b", "c", "d"}) {
        model.groups.push_back(group_of(link, {}, flat_tree({{{0, 0, 0}, 0.5}})));
    }
    model.ignored_pairs = {{"a", "b", "Adjacent"}, {"b", "c", "Adjacent"}, {"a", "c", "Never"}};
    model.into = TextFile{"mine", text};
    return model;
}

std::string written(const std::string& plugin, const std::string& stage, const std::string& text,
                    const std::string& pairs, Told& told) {
    return writer(plugin, stage, {{"pairs", pairs}})->write(model_into(text), told);
}

/// Returns the text up to what the spheres replace.
std::string before(const std::string& text, const std::string& mark) {
    return text.substr(0, text.find(mark));
}

constexpr const char* srdf = R"(<robot name='r'>
  <disable_collisions link1=' b' link2='a'   reason='User'/> <!-- a shield -->
  <disable_collisions link1="c" link2="d" reason="User"/>
  <disable_collisions link1="d" link2="c"/>
  <enable_collisions link1="c" link2="b"/>
)";

TEST(PairsInto, AnSrdfKeepsItsPairs) {
    const auto pairs = [](const std::string& how, Told& told) {
        return before(written("xml_models", "write.srdf", std::string(srdf) + "</robot>\n", how, told),
                      "  <link_sphere_approximation");
    };
    Told keep, merge, replace;
    EXPECT_EQ(pairs("keep", keep), srdf);
    EXPECT_THAT(keep.notes, ElementsAre("mine: pairs: 2 kept"));
    EXPECT_EQ(pairs("merge", merge),
              std::string(srdf) + "  <disable_collisions link1=\"a\" link2=\"c\" reason=\"Never\"/>\n")
        << "neither in the other order, nor what the user enables";
    EXPECT_THAT(merge.notes, ElementsAre("mine: pairs: 2 kept, 1 added, 0 removed"));
    EXPECT_THAT(merge.warnings, IsEmpty());
    const std::string replaced = pairs("replace", replace);
    EXPECT_THAT(replaced, HasSubstr("link1=\"a\" link2=\"b\" reason=\"Adjacent\""));
    EXPECT_THAT(replaced, HasSubstr("link1=\"a\" link2=\"c\" reason=\"Never\""));
    EXPECT_THAT(replaced, HasSubstr("<enable_collisions link1=\"c\" link2=\"b\"/>"));
    EXPECT_THAT(replaced, Not(HasSubstr("User")));
    EXPECT_THAT(replaced, Not(HasSubstr("link1=\"b\" link2=\"c\"")));
    EXPECT_THAT(replace.notes, ElementsAre("mine: pairs: 1 kept, 1 added, 1 removed"));
    EXPECT_THAT(replace.warnings, ElementsAre("mine: these pairs are checked from now on, as 'pairs: replace' removes "
                                              "them: c with d (User); remedy: 'pairs: merge' keeps them"));
}

TEST(PairsInto, DefaultsOfAnSrdfStay) {
    Told told;
    const std::string text =
        written("xml_models", "write.srdf", "<robot name='r'>\n  <disable_default_collisions link='a'/>\n</robot>\n",
                "merge", told);
    EXPECT_THAT(text, HasSubstr("link1=\"b\" link2=\"c\""));
    EXPECT_THAT(text, Not(HasSubstr("link1=\"a\"")));
}

TEST(PairsInto, KeepIsTheDefaultAndSaysWhatAFileWithoutPairsLacks) {
    Told told;
    const std::string text =
        writer("xml_models", "write.srdf")->write(model_into("<robot name='r'>\n</robot>\n"), told);
    EXPECT_THAT(text, Not(HasSubstr("disable_collisions")));
    EXPECT_THAT(told.warnings,
                ElementsAre("mine: it lists no pairs of links that need no check, and gets none; remedy: "
                            "'pairs: merge' adds them"));
}

TEST(PairsInto, UnknownPairsRemoveNone) {
    Told told;
    SphereModel model = model_into(std::string(srdf) + "</robot>\n");
    model.ignored_pairs.reset();
    EXPECT_EQ(before(writer("xml_models", "write.srdf", {{"pairs", std::string("replace")}})->write(model, told),
                     "  <link_sphere_approximation"),
              srdf);
    EXPECT_THAT(told.warnings, ElementsAre("mine: the pairs of links that need no check are not known: its own 2 stay; "
                                           "remedy: give the robot's URDF"));
}

TEST(PairsInto, AnMjcfKeepsItsPairs) {
    const std::string text =
        R"(<mujoco><worldbody><body name="a"/><body name="b"/><body name="c"/><body name="d"/></worldbody>
  <contact>
    <exclude name="mine" body1="b" body2="a"/>
    <exclude body1="c" body2="d"/>
  </contact>
  <contact/>
</mujoco>)";
    const auto contact = [&](const std::string& how, Told& told) {
        const std::string result = written("xml_models", "write.mjcf", text, how, told);
        return result.substr(result.find("<contact>"));
    };
    Told keep, merge, replace;
    EXPECT_EQ(contact("keep", keep), text.substr(text.find("<contact>")));
    EXPECT_EQ(contact("merge", merge), R"(<contact>
    <exclude name="mine" body1="b" body2="a"/>
    <exclude body1="c" body2="d"/>
    <exclude body1="b" body2="c"/>
    <exclude body1="a" body2="c"/>
  </contact>
  <contact/>
</mujoco>)");
    EXPECT_THAT(contact("replace", replace), Not(HasSubstr("body2=\"d\"")));
    EXPECT_THAT(replace.warnings.back(), HasSubstr("removes them: c with d; remedy"));
}

constexpr const char* ignored = "    self_collision_ignore:   # ours\n"
                                "      b: [a]   # a shield\n"
                                "      c:\n"
                                "      - d\n";

TEST(PairsInto, ACuroboFileKeepsItsPairs) {
    const std::string text = std::string("kinematics:\n    collision_link_names: []\n    collision_spheres: {}\n") +
                             ignored + "    base_link: a   # last\n";
    const auto pairs = [&](const std::string& how, Told& told) {
        const std::string result = written("yaml_models", "write.curobo", text, how, told);
        return result.substr(result.find("    self_collision_ignore"));
    };
    Told keep, merge, replace;
    EXPECT_EQ(pairs("keep", keep), std::string(ignored) + "    base_link: a   # last\n");
    EXPECT_EQ(pairs("merge", merge), "    self_collision_ignore:   # ours\n"
                                     "      b: [a, c]   # a shield\n"
                                     "      c:\n"
                                     "      - d\n"
                                     "      a: [c]\n"
                                     "    base_link: a   # last\n");
    EXPECT_THAT(merge.notes, ElementsAre("mine: pairs: 2 kept, 2 added, 0 removed"));
    EXPECT_THAT(pairs("replace", replace), HasSubstr("a: [b, c]"));
    EXPECT_THAT(replace.warnings, ElementsAre(HasSubstr("removes them: c with d; remedy")));
}

TEST(PairsInto, AnXrdfKeepsItsPairs) {
    const std::string text = "format: xrdf\ncollision: {geometry: g}\ngeometry: {g: {spheres: {}}}\n"
                             "self_collision: {geometry: g, ignore: {b: [a], c: [d]}}\n";
    Told told;
    EXPECT_THAT(written("yaml_models", "write.xrdf", text, "keep", told), HasSubstr("ignore: {b: [a], c: [d]}}\n"));
    EXPECT_THAT(written("yaml_models", "write.xrdf", text, "merge", told),
                HasSubstr("ignore: {b: [a, c], c: [d], a: [c]}}\n"));
    EXPECT_THAT(written("yaml_models", "write.xrdf",
                        "format: xrdf\ncollision: {geometry: g}\ngeometry: {g: {spheres: {}}}\n"
                        "self_collision: {geometry: g}\n",
                        "merge", told),
                HasSubstr("self_collision: {geometry: g, ignore: {a: [b, c], b: [c]}}\n"));
}

TEST(PairsInto, AFileOfPlainmpListsWhatIsChecked) {
    const std::string text = "self_collision_pairs: [[d,  a], [b, c]] # tuned\n"
                             "collision_spheres: {a: {spheres: []}, b: {spheres: []}, c: {spheres: []}}\n";
    Told keep, merge, replace;
    EXPECT_THAT(written("yaml_models", "write.plainmp", text, "keep", keep),
                HasSubstr("self_collision_pairs: [[d,  a], [b, c]] # tuned\n"));
    EXPECT_THAT(written("yaml_models", "write.plainmp", text, "merge", merge),
                HasSubstr("self_collision_pairs: [[a, d], [b, d], [c, d]] # tuned\n"))
        << "a link without spheres before has no pairs that the user switched off; [b, c] needs no check";
    EXPECT_THAT(written("yaml_models", "write.plainmp", text, "replace", replace),
                HasSubstr("self_collision_pairs: [[a, d], [b, d], [c, d]] # tuned\n"));
}

} // namespace
} // namespace foam::test
