// Experiments in a folder of their own, read and run as `foam bench` does.
#pragma once

#include "support/temporary_folder.hpp"

#include <foam/bench/experiment.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace foam {

class ExperimentTest : public testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"FOAM_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "FOAM_SHARED"}) {
            ::unsetenv(name);
        }
        registry.load_directory(FOAM_TEST_PLUGINS);
    }

    std::filesystem::path path() const { return folder.path(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path() / name, std::ios::binary) << text;
    }
    /// Returns a line for each finding.
    std::string findings(const std::string& text) const {
        std::string all;
        for (const Diagnostic& finding : parse_experiment(text, "x.yaml", registry).diagnostics) {
            all += finding.text() + "\n";
        }
        return all;
    }
    /// Runs an experiment whose file would lie in the folder.
    ExperimentResult run(const std::string& text, const ExperimentOptions& options = {}) const {
        const ExperimentReading read = parse_experiment(text, path() / "x.yaml", registry);
        EXPECT_TRUE(read.ok()) << (read.diagnostics.empty() ? "" : read.diagnostics.front().text());
        return run_experiment(*read.experiment, registry, options);
    }

    TemporaryFolder folder;
    Registry registry;
};

} // namespace foam
