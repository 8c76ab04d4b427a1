// A registry with the fixture stages, and recipes in short form.
#pragma once

#include <foam/recipe/recipe.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace foam::test {

/// The fixture stages, and those that a recipe falls back on.
inline void load_fixtures(Registry& registry) {
    for (const char* name : {"/fixture_stages.so", "/fixture_defaults.so"}) {
        const PluginRecord& record = registry.load(std::string(FOAM_TEST_FIXTURES) + name);
        ASSERT_TRUE(record.loaded()) << record.file << ": " << record.rejection;
    }
}

inline std::string read_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// All findings, one a line.
inline std::string text_of(const std::vector<Diagnostic>& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        text += diagnostic.text() + "\n";
    }
    return text;
}

} // namespace foam::test
