// Walks the recipes in tests/recipes: bad ones have exactly the findings written beside them (FOAM_TEST_UPDATE=1 writes
// them anew: read the difference), good ones have none and survive being written and read again.
#include "support.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> recipes_in(const std::string& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(FOAM_TEST_SOURCE) / "tests/recipes" / folder)) {
        if (entry.path().extension() == ".yaml") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Reads it under the path that it has seen from the folder of recipes, so that messages are the same everywhere.
RecipeResult read_relative(const fs::path& file, Registry& registry, const std::vector<std::string>& variants = {}) {
    fs::current_path(fs::path(FOAM_TEST_SOURCE) / "tests/recipes");
    return parse_recipe(read_file(file), file.parent_path().filename() / file.filename(), registry, {}, variants);
}

TEST(RecipeFiles, BadOnesHaveExactlyTheirFindings) {
    const auto files = recipes_in("bad");
    EXPECT_GE(files.size(), 80U);
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.filename().string());
        Registry registry;
        load_fixtures(registry);
        const RecipeResult result = read_relative(file, registry);
        EXPECT_FALSE(result.ok());
        EXPECT_TRUE(result.recipes.empty());
        fs::path expected = file;
        expected.replace_extension(".expected");
        if (std::getenv("FOAM_TEST_UPDATE")) {
            std::ofstream(expected, std::ios::binary) << text_of(result.diagnostics);
        }
        EXPECT_EQ(text_of(result.diagnostics), read_file(expected));
    }
}

TEST(RecipeFiles, GoodOnesHaveNoFinding) {
    const auto files = recipes_in("good");
    EXPECT_GE(files.size(), 12U);
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.filename().string());
        Registry registry;
        load_fixtures(registry);
        const RecipeResult result = read_relative(file, registry);
        EXPECT_EQ(text_of(result.diagnostics), "");
        ASSERT_TRUE(result.ok());
        ASSERT_FALSE(result.recipes.empty());
    }
}

TEST(RecipeFiles, WrittenRecipesReadBackEqual) {
    for (const fs::path& file : recipes_in("good")) {
        SCOPED_TRACE(file.filename().string());
        Registry registry;
        load_fixtures(registry);
        RecipeResult read = read_relative(file, registry);
        if (!read.variants.empty()) {
            const RecipeResult variants = read_relative(file, registry, {"*"});
            read.recipes.insert(read.recipes.end(), variants.recipes.begin(), variants.recipes.end());
        }
        for (const Recipe& recipe : read.recipes) {
            const std::string text = to_yaml(recipe, registry);
            const RecipeResult again = parse_recipe(text, recipe.file, registry);
            EXPECT_EQ(text_of(again.diagnostics), "") << text;
            ASSERT_EQ(again.recipes.size(), 1U);
            EXPECT_EQ(to_yaml(again.recipes[0], registry), text);
        }
    }
}

} // namespace
} // namespace foam::test
