// Whole runs in a folder of their own.
#pragma once

#include "support/temporary_folder.hpp"
#include "support/read_spheres.hpp"

#include <foam/runtime/run.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace foam::test {

/// With the plugins that the test depends on; names of files are relative to the folder.
class RunTest : public testing::Test {
protected:
    RunTest() { registry.load_directory(FOAM_TEST_PLUGINS); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder.path() / name, std::ios::binary) << text;
    }
    std::string text_of(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(folder.path() / name, std::ios::binary).rdbuf();
        return text.str();
    }
    /// `text`: without its first line, `foam: 1`. What is found fails the test.
    Recipe recipe_of(const std::string& text) {
        const RecipeResult result = parse_recipe("foam: 1\n" + text, folder.path() / "recipe.yaml", registry);
        for (const Diagnostic& finding : result.diagnostics) {
            ADD_FAILURE() << finding.text();
        }
        return result.recipes.at(0);
    }
    RunOptions options(const std::string& out = "out") const {
        RunOptions result;
        result.out = folder.path() / out;
        result.fresh = true;
        return result;
    }
    /// Of a URDF, by link.
    std::map<std::string, std::vector<Sphere>> spheres_in(const std::string& name) const {
        return read_spheres(*registry.make<Writer>("write.urdf"), text_of(name));
    }

    TemporaryFolder folder;
    Registry registry;
};

} // namespace foam::test
