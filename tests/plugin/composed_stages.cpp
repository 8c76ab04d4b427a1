// Stages that are made of stages of other plugins.
#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

namespace foam::test {
namespace {

const Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};

void load(Registry& registry, const char* fixture) {
    const PluginRecord& record = registry.load(FOAM_TEST_FIXTURES "/" + std::string(fixture) + ".so");
    ASSERT_TRUE(record.loaded()) << record.rejection;
}

std::string refusal(const Registry& registry, const char* stage) {
    try {
        registry.make<MeshFilter>(stage);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::plugin);
        return error.what();
    }
    ADD_FAILURE() << stage << " was made";
    return {};
}

TEST(ComposedStages, UseWhatIsThere) {
    Registry registry;
    load(registry, "fixture_composed");
    QuietContext context;
    EXPECT_EQ(registry.make<MeshFilter>("repair.composed")->apply(triangle, context),
              triangle); // not there: does without
    load(registry, "fixture_used");
    EXPECT_EQ(registry.make<MeshFilter>("repair.composed")->apply(triangle, context).vertices[0], (Vec3{1, 0, 0}));
}

TEST(ComposedStages, NameWhatTheyUse) {
    Registry registry;
    load(registry, "fixture_composed");
    load(registry, "fixture_used");
    EXPECT_EQ(refusal(registry, "repair.unnamed"),
              "repair.unnamed: it asks for stage 'repair.shift' without naming it; "
              "remedy: add it to StageInfo::uses");
    EXPECT_EQ(refusal(registry, "repair.nested"), "repair.nested: it uses stage 'repair.composed', which is made of "
                                                  "others itself; remedy: use those");
}

} // namespace
} // namespace foam::test
