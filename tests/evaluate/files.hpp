// Files of a test, and the plugins that read them.
#pragma once

#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/evaluate.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace foam::test {

class Files : public ::testing::Test {
protected:
    Files() {
        for (const char* name : {"load_urdf", "load_mesh", "read_rows", "yaml_models", "write_csv", "write_ply"}) {
            const PluginRecord& record =
                registry.load(std::filesystem::path(FOAM_TEST_PLUGINS) / (name + std::string(".so")));
            EXPECT_TRUE(record.loaded()) << record.rejection;
        }
    }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / name, std::ios::binary) << text;
        return folder_.path() / name;
    }

    SphereFile read(const std::string& text) const { return read_sphere_file(write("spheres", text), registry); }

    /// The message for a text that is refused, with FILE for the file.
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const Error& error) {
            std::string message = error.what();
            const std::string file = (folder_.path() / "spheres").string();
            for (std::size_t at = message.find(file); at != message.npos; at = message.find(file)) {
                message.replace(at, file.size(), "FILE");
            }
            return message;
        }
        return "";
    }

    Registry registry;

private:
    TemporaryFolder folder_;
};

} // namespace foam::test
