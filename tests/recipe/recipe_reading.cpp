// Files that are no files, and texts that are no recipes: findings, never a crash or a hang.
#include "support.hpp"

#include <foam/base/random.hpp>

#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

class RecipeReading : public testing::Test {
protected:
    void SetUp() override {
        load_fixtures(registry_);
        folder_ = fs::temp_directory_path() / ("foam_recipe_reading_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }

    Registry registry_;
    fs::path folder_;
};

TEST_F(RecipeReading, ReadsAFile) {
    const fs::path file = write("cube.yaml", "foam: 1\nmesh: cube.stl\nstages: [spherize.fixture]\n");
    const RecipeResult result = read_recipe(file, registry_);
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    EXPECT_EQ(result.recipes.at(0).file, file);
    EXPECT_EQ(result.recipes.at(0).source, read_file(file));
}

TEST_F(RecipeReading, SaysWhyAFileCannotBeRead) {
    const auto findings = [&](const fs::path& file) { return text_of(read_recipe(file, registry_).diagnostics); };
    const std::string folder = folder_.string();
    EXPECT_EQ(findings(folder_ / "none.yaml"),
              folder + "/none.yaml: error[cannot-read]: there is no such file; remedy: check the path\n");
    EXPECT_EQ(findings(folder_), folder + ": error[cannot-read]: it is a folder; remedy: name the recipe file in it\n");
    EXPECT_EQ(findings(""), "recipe: error[cannot-read]: there is no such file; remedy: check the path\n");
    const fs::path secret = write("secret.yaml", "foam: 1\n");
    fs::permissions(secret, fs::perms::none);
    if (geteuid() != 0) {
        EXPECT_EQ(findings(secret),
                  secret.string() +
                      ": error[cannot-read]: it cannot be read (Permission denied); remedy: check its permissions\n");
    }
    for (const char* device : {"/dev/null", "/dev/zero"}) {
        EXPECT_EQ(findings(device), std::string(device) + ": error[cannot-read]: it is a device, not a regular file; "
                                                          "remedy: give the path of a file\n");
    }
    EXPECT_EQ(findings(write("empty.yaml", "")),
              folder + "/empty.yaml:1:1: error[empty]: the recipe is empty; remedy: begin with 'foam: 1', then "
                       "'robot' and 'stages'\n");
    EXPECT_EQ(findings(write("large.yaml", std::string(1'000'001, ' '))),
              folder +
                  "/large.yaml: error[cannot-read]: it has 1000001 bytes, more than 1000000; remedy: check that this "
                  "is a recipe\n");
}

TEST_F(RecipeReading, LoadsPluginsBesideTheRecipe) {
    const fs::path plugin = folder_ / "mine.so";
    fs::copy_file(std::string(FOAM_TEST_FIXTURES) + "/fixture_stages.so", plugin);
    const fs::path file = write("cube.yaml", "foam: 1\nmesh: cube.stl\nplugins: mine.so\noutputs: []\n"
                                             "stages: [spherize.fixture]\n");
    Registry empty;
    const RecipeResult result = read_recipe(file, empty);
    EXPECT_TRUE(result.ok()) << text_of(result.diagnostics);
    EXPECT_NE(empty.find("spherize.fixture"), nullptr);
}

/// Texts on which parsers have crashed or hung.
std::vector<std::string> hostile_texts() {
    constexpr std::size_t n = 100'000;
    const auto repeat = [](const std::string& part, std::size_t times) {
        std::string text;
        for (std::size_t i = 0; i < times; ++i) {
            text += part;
        }
        return text;
    };
    std::vector<std::string> texts = {std::string(2'000'000, 'a'),
                                      std::string(1, '\0'),
                                      "\xff\xfe",
                                      "&a [*a]",
                                      "&a {*a : *a}",
                                      "%YAML 9.9\n---\n",
                                      "--- --- ---",
                                      "!!binary |\n  AAAA",
                                      "\"\\",
                                      "'",
                                      "\"\\x",
                                      "? ",
                                      "?",
                                      ":",
                                      "-",
                                      "- -",
                                      "*",
                                      "&",
                                      "!",
                                      "!<",
                                      "|",
                                      ">",
                                      "|99",
                                      "%",
                                      "@",
                                      "`",
                                      "{",
                                      "}",
                                      "[",
                                      "]",
                                      ",",
                                      "foam: 1\n\t\n",
                                      "\r\r\r",
                                      "\xef\xbb\xbf",
                                      "\xf4\x90\x80\x80",
                                      "\xed\xa0\x80"};
    for (const char* part :
         {"[", "{a: ", "- ",  "? ", "a:\n ", "&a ",   "\"",  "a: ",   "[] ", ",", ": ", "{}\n", "--- ",   "\n",
          "#", " ",    "a\n", "!",  "*a ",   "a b\n", "{? ", "[a]: ", "\t",  "'", "%",  "|\n",  "a: 1\n", "- a: 1\n"}) {
        texts.push_back(repeat(part, n / std::string(part).size()));
    }
    std::string keys = "foam: 1\n";
    for (std::size_t i = 0; i < 20'000; ++i) {
        keys.append("k").append(std::to_string(i)).append(": 1\n");
    }
    texts.push_back(keys);
    texts.push_back("foam: 1\nmesh: " + std::string(500'000, 'x') + "\nstages: [" + std::string(300'000, 'y') + "]\n");
    return texts;
}

TEST_F(RecipeReading, HostileTextsGiveFindings) {
    for (const std::string& text : hostile_texts()) {
        const RecipeResult result = parse_recipe(text, "hostile.yaml", registry_);
        EXPECT_FALSE(result.ok()) << text.substr(0, 40);
        EXPECT_TRUE(result.recipes.empty());
        for (const Diagnostic& diagnostic : result.diagnostics) {
            EXPECT_LT(diagnostic.text().size(), 1000U);
        }
    }
}

TEST_F(RecipeReading, EveryCutAndEveryMutationIsReadOrRefused) {
    const std::string text = read_file(fs::path(FOAM_TEST_SOURCE) / "tests/recipes/good/everything.yaml");
    std::size_t read = 0;
    for (std::size_t length = 0; length <= text.size(); ++length) {
        read += parse_recipe(text.substr(0, length), "cut.yaml", registry_).ok() ? 1 : 0;
    }
    EXPECT_GT(read, 0U);
    const std::string signs = " \t\n:,-[]{}'\"*&!#|>?%@`~0x.e\xc3\x80";
    Random random(7);
    for (int i = 0; i < 3000; ++i) {
        std::string changed = text;
        for (int j = 0; j < 3; ++j) {
            changed[random.below(changed.size())] = signs[random.below(signs.size())];
        }
        const RecipeResult result = parse_recipe(changed, "changed.yaml", registry_);
        EXPECT_EQ(result.ok(), !result.recipes.empty());
    }
}

TEST_F(RecipeReading, ManyFindingsAreCutOff) {
    std::string text = "foam: 1\nmesh: a\nstages: [spherize.fixture]\n";
    for (int i = 0; i < 700; ++i) {
        text.append("q").append(std::to_string(i)).append(": 1\n");
    }
    const RecipeResult result = parse_recipe(text, "many.yaml", registry_);
    ASSERT_EQ(result.diagnostics.size(), 501U);
    EXPECT_EQ(result.diagnostics.back().text(), "many.yaml: error[too-many]: 200 more findings; correct these first");
}

} // namespace
} // namespace foam::test
