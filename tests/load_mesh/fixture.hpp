// Loading files through the registry, as a program does.
#pragma once

#include "support/shared_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace foam::test {

/// Remembers what it is told.
class RecordingContext final : public QuietContext {
public:
    void log(Severity, std::string_view message) override { messages.emplace_back(message); }
    void metric(std::string_view name, double value, std::string_view) override { metrics[std::string(name)] = value; }
    std::vector<std::string> messages;
    std::map<std::string, double> metrics;
};

class LoadMesh : public ::testing::Test {
protected:
    void SetUp() override {
        const PluginRecord& record = registry.load(FOAM_TEST_PLUGINS "/load_mesh.so");
        ASSERT_TRUE(record.loaded()) << record.rejection;
        loader = registry.make<MeshLoader>("load.mesh");
        folder =
            std::filesystem::temp_directory_path() / ("foam_load_" + std::to_string(getpid()) + "_" +
                                                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    Mesh load(const std::filesystem::path& file) { return loader->load(file, context); }
    /// The message of the Error(input) that loading the file throws; empty if it loads.
    std::string error_of(const std::filesystem::path& file) {
        try {
            load(file);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
            EXPECT_EQ(std::string(error.what()).rfind(file.string(), 0), 0u) << "no file name first: " << error.what();
            return error.what();
        }
        return "";
    }
    std::string error_of(const std::string& name, const std::string& bytes) { return error_of(write(name, bytes)); }

    Registry registry;
    std::unique_ptr<MeshLoader> loader;
    std::filesystem::path folder;
    RecordingContext context;
};

} // namespace foam::test
