// The memory of large meshes. The figures are bounds per triangle: copies of the mesh would exceed them.
#include "program.hpp"

#include "geometry/shapes.hpp"

#include <foam/sdk/abi.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <spawn.h>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <vector>

namespace foam::test {
namespace {

class CliMemory : public Cli {
protected:
    /// Writes a mesh as binary STL, in which every triangle has its own corners.
    void write_stl(const std::string& name, const Mesh& mesh) const {
        std::string bytes(80, ' ');
        const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
        bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
        for (const Triangle& t : mesh.triangles) {
            std::array<float, 12> values{};
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& p = mesh.vertices[t[k]];
                values[3 + 3 * k] = static_cast<float>(p.x);
                values[4 + 3 * k] = static_cast<float>(p.y);
                values[5 + 3 * k] = static_cast<float>(p.z);
            }
            bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values).append(2, '\0');
        }
        write(name, bytes);
    }

    /// Runs the program; returns the most memory that was resident, in bytes.
    double memory_of(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), FOAM_TEST_BINARY);
        std::vector<char*> pointers;
        for (std::string& argument : arguments) {
            pointers.push_back(argument.data());
        }
        pointers.push_back(nullptr);
        pid_t child = 0;
        EXPECT_EQ(posix_spawn(&child, FOAM_TEST_BINARY, nullptr, nullptr, pointers.data(), environ), 0);
        int status = 0;
        double most = 0;
        while (waitpid(child, &status, WNOHANG) == 0) { // rusage would count the memory of this process, too
            most = std::max(most, resident_so_far(child));
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        EXPECT_EQ(status, 0);
        return most;
    }

private:
    static double resident_so_far(pid_t id) {
        std::ifstream status("/proc/" + std::to_string(id) + "/status");
        for (std::string word; status >> word;) {
            if (double kilobytes = 0; word == "VmHWM:" && status >> kilobytes) {
                return 1024 * kilobytes;
            }
        }
        return 0;
    }
};

TEST_F(CliMemory, OfALargeMesh) {
    if (std::string_view(FOAM_ABI_SANITIZER) != "none") {
        GTEST_SKIP() << "a sanitizer needs memory of its own";
    }
    const Mesh large = sample::torus(0.1, 0.04, 500, 500), small = sample::torus(0.1, 0.04, 20, 20);
    write_stl("large.stl", large);
    write_stl("small.stl", small);
    const auto memory = [&](const std::string& mesh) {
        return memory_of({"spherize", path() / mesh, "-n", "4", "-j", "1", "--fresh", "-o", path() / "spheres.json",
                          "--json", "--set", "stages.spherize.cover.effort=fast"});
    };
    const double more = memory("large.stl") - memory("small.stl");
    EXPECT_GT(more / static_cast<double>(large.triangles.size()), 30) << "the mesh itself";
    EXPECT_LT(more / static_cast<double>(large.triangles.size()), 200) << "bytes per triangle";
}

/// A ball is 2,304 triangles: those of thousands in one link would fill the memory.
TEST_F(CliMemory, OfALinkOfManyElements) {
    if (std::string_view(FOAM_ABI_SANITIZER) != "none") {
        GTEST_SKIP() << "a sanitizer needs memory of its own";
    }
    std::string urdf = "<robot name='r'><link name='a'>";
    for (int i = 0; i < 5000; ++i) {
        urdf += "<collision><origin xyz='" + std::to_string(i % 50) + " " + std::to_string(i / 50 % 50) + " " +
                std::to_string(i / 2500) + "'/><geometry><sphere radius='0.1'/></geometry></collision>";
    }
    write("many.urdf", urdf + "</link></robot>");
    EXPECT_LT(memory_of({"spherize", path() / "many.urdf", "-n", "4", "-j", "1", "--fresh", "-q", "-o",
                         path() / "spheres.urdf"}),
              300e6);
}

} // namespace
} // namespace foam::test
