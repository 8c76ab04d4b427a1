// Where plugins are looked for, and what is near to a word.
#include "support/environment_variable.hpp"

#include <foam/base/text.hpp>
#include <foam/sdk/registry.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

/// For the life of the object.
struct PluginPath : EnvironmentVariable {
    explicit PluginPath(const char* value) : EnvironmentVariable("FOAM_PLUGIN_PATH", value) {}
};

TEST(PluginDirectories, AreExtraThenEnvironmentThenInstalled) {
    const fs::path installed = fs::canonical(FOAM_TEST_PLUGINS);
    {
        const PluginPath path(nullptr);
        EXPECT_THAT(plugin_directories(), ElementsAre(installed));
        EXPECT_THAT(plugin_directories({"/extra", "relative"}), ElementsAre("/extra", "relative", installed));
    }
    const PluginPath path("/one:/two words");
    EXPECT_THAT(plugin_directories({"/extra"}), ElementsAre("/extra", "/one", "/two words", installed));
}

TEST(PluginDirectories, AreNeverRelativeToTheCurrentFolder) {
    const fs::path installed = fs::canonical(FOAM_TEST_PLUGINS);
    for (const char* value : {"", ":", "::", ".", "plugins", "./plugins:..", ":plugins:"}) {
        const PluginPath path(value);
        EXPECT_THAT(plugin_directories(), ElementsAre(installed)) << value;
    }
    const PluginPath path(":/one::plugins:/two:");
    EXPECT_THAT(plugin_directories(), ElementsAre("/one", "/two", installed));
}

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("abc", "abc"), 0U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("abc", ""), 3U);
    EXPECT_EQ(edit_distance("abc", "abd"), 1U);
    EXPECT_EQ(edit_distance("abc", "abcd"), 1U);
    EXPECT_EQ(edit_distance("abc", "ac"), 1U);
    EXPECT_EQ(edit_distance("abc", "acb"), 1U);
    EXPECT_EQ(edit_distance("ca", "abc"), 3U); // optimal string alignment: no edit within a swap
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(NearestWord, IsASlipOfTheHand) {
    const std::vector<std::string> words = {"spheres", "stages", "seed", "per"};
    EXPECT_EQ(nearest_word("sphere", words), "spheres");
    EXPECT_EQ(nearest_word("satges", words), "stages");
    EXPECT_EQ(nearest_word("sede", words), "seed");
    EXPECT_EQ(nearest_word("stages", words), "stages");
    EXPECT_EQ(nearest_word("budget", words), "");
    EXPECT_EQ(nearest_word("xyz", words), "");
    EXPECT_EQ(nearest_word("", words), "");
    EXPECT_EQ(nearest_word("per", {}), "");
    EXPECT_EQ(nearest_word("averyveryveryverylongword", {"anotherveryverylongword"}), "");
}

class RegistrySearch : public testing::Test {
protected:
    void SetUp() override { registry_.load_directory(FOAM_TEST_FIXTURES); }
    Registry registry_;
};

TEST_F(RegistrySearch, NearestStageMindsTheMethod) {
    EXPECT_EQ(registry_.nearest("simplify.fixtrue"), "simplify.fixture");
    EXPECT_EQ(registry_.nearest("osmesa"), "snapshot.osmesa");
    EXPECT_EQ(registry_.nearest("render.osmesa"), "snapshot.osmesa");
    EXPECT_EQ(registry_.nearest("write.jsno"), "write.json");
    EXPECT_EQ(registry_.nearest("jsn"), "write.json");
    EXPECT_EQ(registry_.nearest("polish.everything"), "");
    EXPECT_EQ(registry_.nearest(""), "");
    EXPECT_EQ(Registry().nearest("write.json"), "");
}

TEST_F(RegistrySearch, FindsByFileEndingAndKind) {
    const auto name = [&](StageKind kind, std::string_view extension) -> std::string {
        const RegisteredStage* stage = registry_.find_for_extension(kind, extension);
        return stage ? stage->info.name : "";
    };
    EXPECT_EQ(name(StageKind::mesh_loader, "stl"), "load.fixture");
    EXPECT_EQ(name(StageKind::mesh_loader, "STL"), "load.fixture");
    EXPECT_EQ(name(StageKind::mesh_loader, "aside"), "load.aside");
    EXPECT_EQ(name(StageKind::writer, "Json"), "write.json");
    EXPECT_EQ(name(StageKind::writer, "stl"), "");
    EXPECT_EQ(name(StageKind::mesh_loader, ""), "");
    EXPECT_EQ(name(StageKind::mesh_loader, ".stl"), "");
}

TEST_F(RegistrySearch, ThePreferredStageGoesFirstAndThoseOfLastResortLast) {
    const auto name = [&](std::string_view extension, std::string_view preferred) {
        return registry_.find_for_extension(StageKind::mesh_loader, extension, preferred)->info.name;
    };
    EXPECT_EQ(name("stl", ""), "load.fixture");
    EXPECT_EQ(name("STL", "load.aside"), "load.aside");
    EXPECT_EQ(name("stl", "load.fixture"), "load.fixture");
    EXPECT_EQ(name("obj", "load.aside"), "load.fixture") << "load.aside does not read it";
    EXPECT_EQ(name("stl", "write.json"), "load.fixture") << "of another kind";
}

TEST_F(RegistrySearch, ListsStagesByName) {
    std::vector<std::string> names;
    for (const auto& [name, stage] : registry_.stages()) {
        names.push_back(name);
        EXPECT_EQ(registry_.find(name), &stage);
        EXPECT_FALSE(stage.plugin.empty());
    }
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    std::size_t enrolled = 0;
    for (const PluginRecord& plugin : registry_.plugins()) {
        enrolled += plugin.stages.size();
    }
    EXPECT_EQ(names.size(), enrolled);
    EXPECT_GE(enrolled, 10U);
    EXPECT_EQ(registry_.find("write"), nullptr);
    EXPECT_EQ(registry_.find(""), nullptr);
}

} // namespace
} // namespace foam::test
