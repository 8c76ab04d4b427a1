// What every writer promises of elements other than spheres, asked of all that are built.
#include "elements.hpp"
#include "support/read_spheres.hpp"

#include <foam/sdk/kinds.hpp>

#include <gmock/gmock.h>

#include <set>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

/// Calls test(name, info, writer) for every writer with its default parameters and for every value of its choices.
template <class Test> void for_each_writer(const Test& test) {
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    int count = 0;
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind != StageKind::writer) {
            continue;
        }
        ++count;
        SCOPED_TRACE(name);
        const auto needed = needed_parameters(name, {"only"});
        test(name, stage.info, *registry.make<Writer>(name, needed));
        for (const Parameter& parameter : stage.info.parameters) {
            for (const std::string& choice : parameter.choices) {
                if ((name == "write.json" && choice != "links") || parameter.name == "engine") {
                    continue; // layouts of spheres; engines_test has those
                }
                SCOPED_TRACE(parameter.name + ": " + choice);
                auto given = needed;
                given[parameter.name] = choice;
                test(name, stage.info, *registry.make<Writer>(name, given));
            }
        }
    }
    EXPECT_GE(count, 15);
}

SphereModel model_with(const std::vector<Element>& elements, std::vector<Sphere> spheres = {}) {
    return model_of(turning("only"), {group_of("only", {"a.stl"}, level_of(std::move(spheres), elements))});
}

bool holds_kind(const StageInfo& info, Kind kind) {
    return std::find(info.kinds.begin(), info.kinds.end(), kind) != info.kinds.end();
}

Elements round_trip(const Writer& writer, const SphereModel& model) {
    QuietContext context;
    auto read = writer.read(writer.write(model, context), writer.files_beside(model, context));
    EXPECT_EQ(read.size(), 1U);
    return read["only"];
}

TEST(ElementWriters, KindsThatAWriterHoldsComeBackAsElementsThatContainThem) {
    std::set<std::string> holders;
    for_each_writer([&](const std::string& name, const StageInfo& info, const Writer& writer) {
        for (const Element& element : awkward_elements()) {
            SCOPED_TRACE(to_string(element.kind));
            if (!holds_kind(info, element.kind)) {
                continue;
            }
            const SphereModel model = model_with({element});
            const Elements back = round_trip(writer, model);
            // A swept box or an ellipsoid as a hull of 8 segments is the widest; planners' worlds have other forms of
            // round ones, too.
            const bool other_form = element.kind == Kind::swept_box || element.kind == Kind::ellipsoid || name == "write.curobo_scene";
            expect_contained(element, back, name == "write.vamp_world" ? 2 : other_form ? 0.3 : 1e-3);
            holders.insert(name);
        }
    });
    EXPECT_THAT(holders, testing::UnorderedElementsAre("write.csv", "write.curobo_scene", "write.gltf", "write.json",
                                                       "write.markers", "write.mjcf", "write.moveit_scene", "write.ply",
                                                       "write.sdf", "write.urdf", "write.usd", "write.vamp_world",
                                                       "write.xacro"));
}

TEST(ElementWriters, OtherKindsAreRefusedByName) {
    for_each_writer([&](const std::string&, const StageInfo& info, const Writer& writer) {
        for (const Element& element : one_of_each()) {
            if (!holds_kind(info, element.kind) && !info.consumer.elements_optional) { // an SRDF has pairs without them
                EXPECT_THAT(refusal(writer, model_with({element})),
                            testing::AllOf(HasSubstr(noun_of(element.kind, 1)), HasSubstr("remedy")));
            }
        }
    });
}

TEST(ElementWriters, SpheresKeepTheirBytesBesideElementsOfKindSphere) {
    const Sphere s{{0.1, 0.2, 1.0 / 3}, 0.4};
    QuietContext context;
    for_each_writer([&](const std::string&, const StageInfo&, const Writer& writer) {
        Element as_element{.kind = Kind::sphere, .pose = awkward_pose(), .radius = s.radius};
        as_element.pose.translation = s.center;
        const SphereModel model = model_with({as_element});
        EXPECT_EQ(read_spheres(writer, writer.write(model, context)),
                  (std::map<std::string, std::vector<Sphere>>{{"only", {s}}}));
    });
}

TEST(ElementWriters, SpheresAndElementsOfALinkAreKeptApart) {
    const std::vector<Sphere> spheres{{{1, 2, 3}, 0.5}, {{0, 0, 0.1}, 0.25}};
    for_each_writer([&](const std::string&, const StageInfo& info, const Writer& writer) {
        if (holds_kind(info, Kind::box)) {
            const Elements back = round_trip(writer, model_with({box({}, {0.5, 0.25, 1})}, spheres));
            EXPECT_EQ(back.spheres(), spheres);
            ASSERT_EQ(back.shaped().size(), 1U);
            EXPECT_EQ(back.shaped()[0], box({}, {0.5, 0.25, 1})) << "half and full extents, axes";
        }
    });
}

TEST(ElementWriters, EqualModelsGiveEqualBytesAndFiles) {
    for_each_writer([&](const std::string&, const StageInfo& info, const Writer& writer) {
        std::vector<Element> held = one_of_each();
        std::erase_if(held, [&](const Element& element) { return !holds_kind(info, element.kind); });
        if (held.empty()) {
            return;
        }
        QuietContext one(1), two(2);
        EXPECT_EQ(writer.write(model_with(held), one), writer.write(model_with(held), two));
        EXPECT_EQ(writer.files_beside(model_with(held), one), writer.files_beside(model_with(held), two));
    });
}

TEST(ElementWriters, WhatCameBackComesBackAgainToTheBit) {
    for_each_writer([&](const std::string&, const StageInfo& info, const Writer& writer) {
        for (const Element& element : awkward_elements()) {
            if (!holds_kind(info, element.kind)) {
                continue;
            }
            SCOPED_TRACE(to_string(element.kind));
            const Elements once = round_trip(writer, model_with({element}));
            for (const Element& e : once.shaped()) {
                if (e.kind == Kind::hull) { // its corners are exact in single precision now
                    const Elements twice = round_trip(writer, model_with({e}));
                    ASSERT_EQ(twice.shaped().size(), 1U);
                    EXPECT_EQ(twice.shaped()[0].hull->surface.vertices.size(), e.hull->surface.vertices.size());
                    EXPECT_EQ(twice.shaped()[0].pose.translation, e.pose.translation);
                }
            }
        }
    });
}

TEST(ElementWriters, RefuseElementsThatNoReaderTakes) {
    Pose mirrored;
    mirrored.rotation[0].x = -1;
    Pose scaled;
    scaled.rotation[0].x = 2;
    for (const Element& bad : {box({}, {0, 1, 1}), capsule({}, 1, 0), capsule({}, -1, 1), box({}, {NAN, 1, 1}),
                               box(mirrored, {1, 1, 1}), box(scaled, {1, 1, 1}), cylinder({}, 1, INFINITY)}) {
        for_each_writer([&](const std::string&, const StageInfo&, const Writer& writer) {
            SphereModel model = model_with({box({}, {1, 1, 1})}, {{{0, 0, 0}, 1}});
            model.groups[0].tree.levels.back().elements.shaped()[0] = bad;
            EXPECT_THAT(refusal(writer, model),
                        HasSubstr(std::string(to_string(bad.kind)) + " 1 of link 'only' cannot be written"));
        });
    }
}

TEST(HullNames, AreFilesAnywhereAndDiffer) {
    HullNames names("my robot.urdf");
    std::set<std::string> seen;
    for (const char* link : {"a b", "a_b", "A_B", "a\"b", "..", "", "a/b", "a_b_1", "\xc3\xa9", ".hidden", "a_b"}) {
        for (int i = 0; i < 2; ++i) {
            const std::string name = names.next(link);
            EXPECT_TRUE(name.starts_with("my_robot_hulls/")) << name;
            EXPECT_TRUE(name.ends_with(".obj")) << name;
            EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/"),
                      name.npos)
                << name;
            EXPECT_EQ(name.find('/', name.find('/') + 1), name.npos) << name;
            std::string lower = name;
            std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
            EXPECT_TRUE(seen.insert(lower).second) << name;
        }
    }
}

TEST(ElementNumbers, GiveTheSameElementBack) {
    for (const Element& element : awkward_elements()) {
        const Element back = element_of(to_string(element.kind), numbers_of(element));
        EXPECT_EQ(back.pose, element.pose);
        EXPECT_EQ(back.half, element.half);
        EXPECT_EQ(back.radius, element.radius);
        if (element.kind == Kind::hull) {
            EXPECT_THAT(back.hull->surface.vertices,
                        testing::UnorderedElementsAreArray(element.hull->surface.vertices));
        }
    }
}

TEST(ElementNumbers, RefuseWhatIsNoElement) {
    const auto message = [](std::string_view kind, const ElementNumbers& numbers) -> std::string {
        try {
            element_of(kind, numbers);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input);
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(message("cone", {}), HasSubstr("'cone' is no kind of element; there are sphere, capsule"));
    EXPECT_EQ(message("box", {{"position", {0, 0, 0}}}), "a box needs 'size'");
    EXPECT_EQ(message("box", {{"position", {0, 0, 0}}, {"size", {1, 1}}}), "size has 2 numbers, not 3");
    EXPECT_EQ(message("box", {{"position", {0, 0, 0}}, {"size", {1, 1, 1}}, {"radius", {1}}}),
              "a box has no 'radius', or has it twice");
    EXPECT_THAT(message("box", {{"position", {0, 0, 0}}, {"size", {1, 1, 0}}}), HasSubstr("the numbers of no box"));
    EXPECT_THAT(message("hull", {{"position", {0, 0, 0}}, {"vertices", {0, 0, 0, 1, 1, 1}}}), HasSubstr("vertices: "));
    EXPECT_EQ(message("hull", {{"position", {0, 0, 0}}, {"vertices", {0, 0, 0, 1}}}), "vertices has 4 numbers, not 3");
}

} // namespace
} // namespace foam::test
