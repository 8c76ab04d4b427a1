// load.assimp in this process, for files that are sound.
#pragma once

#include "exported.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/sdk/registry.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace foam::test {

/// Remembers what it is told.
class Notes final : public QuietContext {
public:
    void log(Severity, std::string_view message) override { messages.emplace_back(message); }
    std::vector<std::string> messages;
};

class LoadAssimp : public ::testing::Test {
protected:
    LoadAssimp() {
        for (const char* plugin : {"/load_assimp.so", "/load_mesh.so"}) {
            const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS) + plugin);
            EXPECT_TRUE(record.loaded()) << record.rejection;
        }
    }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder.path() / name, std::ios::binary) << bytes;
        return folder.path() / name;
    }
    std::filesystem::path exported(const aiScene& scene, const Format& format, const std::string& stem = "mesh") const {
        const auto file = folder.path() / (stem + "." + format.ending);
        export_scene(scene, format.id, file);
        return file;
    }
    Mesh load(const std::filesystem::path& file, const std::map<std::string, ParameterValue>& parameters = {}) {
        return registry.make<MeshLoader>("load.assimp", parameters)->load(file, notes);
    }
    /// The message of the Error(input), without the name of the file that it begins with; empty if it loads.
    std::string error_of(const std::filesystem::path& file,
                         const std::map<std::string, ParameterValue>& parameters = {}) {
        try {
            load(file, parameters);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
            const std::string message = error.what(), name = file.string() + ": ";
            EXPECT_TRUE(message.starts_with(name)) << message;
            return message.substr(std::min(name.size(), message.size()));
        }
        return "";
    }

    TemporaryFolder folder;
    Registry registry;
    Notes notes;
};

/// Area, volume and bounding box, relative to the size.
inline void expect_same(const Mesh& got, const Mesh& wanted, double tolerance = 1e-5) {
    const Box a = bounds(got), b = bounds(wanted);
    const double size = b.diagonal();
    EXPECT_EQ(got.triangles.size(), wanted.triangles.size());
    EXPECT_NEAR(surface_area(got), surface_area(wanted), tolerance * size * size);
    EXPECT_NEAR(signed_volume(got), signed_volume(wanted), tolerance * size * size * size);
    EXPECT_LT(norm(a.low - b.low), tolerance * size);
    EXPECT_LT(norm(a.high - b.high), tolerance * size);
}

} // namespace foam::test
