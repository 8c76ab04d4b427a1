// What engines make of elements in a file holds the elements that the file was made of.
#include "elements.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/kinds.hpp>

#include <gmock/gmock.h>

#include <set>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

/// Elements from a tenth of a millimetre to a metre.
std::vector<Element> of_many_sizes() {
    std::vector<Element> elements{Element{.pose = awkward_pose(), .radius = 0.05}};
    for (const double size : {1e-4, 9e-4, 2e-3, 0.05, 1.0}) {
        const Pose pose = awkward_pose();
        const std::vector<Element> sized{capsule(pose, size, size / 3), cylinder(pose, size / 5, size),
                                         box(pose, {size, size / 20, 3 * size}),
                                         swept_box(pose, {size, size, size}, size),
                                         tetrahedron(pose, size), ellipsoid(pose, {size, size / 2, size / 3})};
        elements.insert(elements.end(), sized.begin(), sized.end());
    }
    return elements;
}

TEST(Engines, HoldTheElementsThatAFileWasMadeOf) {
    std::set<std::string_view> names;
    for (const Engine& engine : engines()) {
        EXPECT_TRUE(names.empty() || *names.rbegin() < engine.name) << "by name, each once";
        names.insert(engine.name);
        EXPECT_FALSE(engine.writers.empty());
        EXPECT_EQ(engine.stated == nullptr, engine.held == nullptr);
        EXPECT_EQ(engine.stated == nullptr, engine.loss.empty()) << engine.name << ": what is added is said";
        for (const Element& element : of_many_sizes()) {
            if (!engine.stated || !knows_all(engine.kinds, {element.kind})) {
                continue;
            }
            const Element stated = engine.stated(element), held = engine.held(stated);
            ASSERT_TRUE(is_valid(stated)) << engine.name;
            for (const Vec3& point : points_of(element, 2000)) {
                constexpr double rounding = 1e-15;
                ASSERT_LE(signed_distance(held, point), rounding) << engine.name << " " << to_string(element.kind);
            }
            for (const Vec3& point : points_of(held, 500)) {
                ASSERT_LE(signed_distance(stated, point), 1e-3) << "the engine's own margin, or less";
            }
        }
    }
}

TEST(Engines, GetWhatTheyNeedFromWritersThatKnowThem) {
    const auto writer_for = [](const char* engine) { return writer("write_urdf", "write.urdf", {{"engine", engine}}); };
    QuietContext context;
    const Element of_test = box({}, {0.1, 0.2, 0.3});
    const SphereModel model =
        model_of(chain_of({"only"}), {group_of("only", {}, level_of({}, {of_test, capsule({}, 0.2, 0.1)}))});
    const auto pybullet = writer_for("pybullet");
    const std::string text = pybullet->write(model, context);
    EXPECT_THAT(text, HasSubstr("<capsule radius=\"0.1\" length=\"0.4\" height=\"0.4\"/>"));
    const Elements held = pybullet->read(text).at("only");
    EXPECT_EQ(held.shaped()[0].kind, Kind::swept_box);
    for (const Vec3& corner : points_of(of_test, 100)) {
        EXPECT_TRUE(holds(held.shaped()[0], corner));
    }
    EXPECT_EQ(writer_for("any")->read(writer_for("any")->write(model, context)).at("only").shaped()[0], of_test);
    EXPECT_THAT(writer_for("drake")->write(model, context), HasSubstr("<drake:capsule"));
}

TEST(Engines, ThoseThatAreNotThereAreNamed) {
    try {
        engine_named("pybulet");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_THAT(error.what(), HasSubstr("no engine 'pybulet'; did you mean 'pybullet'?; there are: coal, "));
    }
}

} // namespace
} // namespace foam::test
