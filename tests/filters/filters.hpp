// The filters under test, made through the registry as the program makes them.
#pragma once

#include "shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/stage.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>

namespace foam::test {

using Settings = std::map<std::string, ParameterValue>;

/// Keeps what a stage reports.
class Listener final : public QuietContext {
public:
    void log(Severity, std::string_view message) override { said += std::string(message) + "\n"; }
    void metric(std::string_view name, double value, std::string_view) override { metrics[std::string(name)] = value; }

    std::string said;
    std::map<std::string, double> metrics;
};

/// The registry with all plugins of the build folder.
inline const Registry& registry() {
    static const std::unique_ptr<const Registry> instance = [] {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(FOAM_TEST_PLUGINS)) {
            if (entry.path().extension() == ".so") {
                files.push_back(entry.path());
            }
        }
        std::sort(files.begin(), files.end());
        auto made = std::make_unique<Registry>();
        for (const std::filesystem::path& file : files) {
            made->load(file);
        }
        return made;
    }();
    return *instance;
}

inline std::unique_ptr<MeshFilter> filter(const std::string& name, const Settings& settings = {}) {
    return registry().make<MeshFilter>(name, settings);
}

inline Mesh filtered(const std::string& name, const Mesh& mesh, const Settings& settings = {}) {
    QuietContext context;
    return filter(name, settings)->apply(mesh, context);
}

/// The message of the geometry error that the filter throws.
inline std::string refusal(const std::string& name, const Mesh& mesh, const Settings& settings = {}) {
    try {
        filtered(name, mesh, settings);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        return error.what();
    }
    ADD_FAILURE() << name << " did not refuse the mesh";
    return {};
}

/// Closed, oriented, 2-manifold, positive volume.
inline void expect_solid(const Mesh& mesh) {
    EXPECT_TRUE(is_usable(mesh));
    const Topology defects = topology(mesh);
    EXPECT_TRUE(defects.closed_manifold()) << describe(defects);
    EXPECT_GT(signed_volume(mesh), 0);
}

} // namespace foam::test
