// A small robot whose every stage has something to compute: a bumpy mesh, and a cylinder.
#pragma once

#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace foam::test {

/// A closed mesh whose corners have no short coordinates.
inline std::string bumpy_obj() {
    constexpr int rings = 9, sectors = 14;
    std::string text = "v 0 0 0.11\nv 0 0 -0.12\n";
    for (int r = 1; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const double polar = std::numbers::pi * r / rings, around = 2 * std::numbers::pi * s / sectors;
            const double radius = 0.1 + 0.02 * std::sin(3 * around + 2 * polar);
            text += "v " + std::to_string(radius * std::sin(polar) * std::cos(around)) + " " +
                    std::to_string(0.7 * radius * std::sin(polar) * std::sin(around)) + " " +
                    std::to_string(radius * std::cos(polar)) + "\n";
        }
    }
    const auto corner = [](int r, int s) { return std::to_string(3 + (r - 1) * sectors + s % sectors); };
    for (int s = 0; s < sectors; ++s) {
        text += "f 1 " + corner(1, s) + " " + corner(1, s + 1) + "\n";
        text += "f 2 " + corner(rings - 1, s + 1) + " " + corner(rings - 1, s) + "\n";
        for (int r = 1; r + 1 < rings; ++r) {
            text += "f " + corner(r, s) + " " + corner(r + 1, s) + " " + corner(r + 1, s + 1) + "\n";
            text += "f " + corner(r, s) + " " + corner(r + 1, s + 1) + " " + corner(r, s + 1) + "\n";
        }
    }
    return text;
}

inline constexpr const char* two_links_urdf =
    "<?xml version=\"1.0\"?>\n"
    "<robot name=\"two\">\n"
    "  <link name=\"base\"><collision><origin xyz=\"0 0.01 0.1\" rpy=\"0.1 0.2 0.3\"/><geometry>"
    "<mesh filename=\"bumpy.obj\" scale=\"1.1 1 0.9\"/></geometry></collision></link>\n"
    "  <link name=\"tip\"><collision><geometry><cylinder radius=\"0.05\" "
    "length=\"0.3\"/></geometry></collision></link>\n"
    "  <joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"tip\"/></joint>\n"
    "</robot>\n";

inline constexpr const char* two_links_recipe =
    "foam: 1\n"
    "name: two\n"
    "robot: {urdf: two.urdf}\n"
    "stages:\n"
    "  - simplify.quadric: {ratio: 0.5, min_triangles: 60, volume_tolerance: 0.5}\n"
    "  - smooth.humphrey: {iterations: 3, volume_tolerance: 0.5}\n"
    "  - spherize.grid\n"
    "budget: {spheres: 9}\n"
    "outputs:\n"
    "  - write.urdf: {file: two.urdf}\n"
    "  - write.json: {file: two.json}\n"
    "  - write.csv: {file: two.csv}\n"
    "debug: {meshes: true}\n";

class Reproduce : public Cli {
protected:
    void SetUp() override {
        write("bumpy.obj", bumpy_obj());
        write("two.urdf", two_links_urdf);
        write("two.yaml", two_links_recipe);
    }

    /// foam, which must end well.
    void must(const std::string& arguments) const {
        const Outcome outcome = foam(arguments);
        ASSERT_EQ(outcome.code, 0) << arguments << "\n" << outcome.out << outcome.err;
    }

    nlohmann::ordered_json manifest(const std::string& directory) const {
        return nlohmann::ordered_json::parse(contents(path() / directory / "manifest.json"));
    }
    void write_manifest(const std::string& directory, const nlohmann::ordered_json& json) const {
        write(directory + "/manifest.json", json.dump());
    }

    /// Equal bytes of all outputs and debug meshes, equal manifests but for the circumstances of the run.
    void expect_same(const std::string& a, const std::string& b) const {
        nlohmann::ordered_json first = manifest(a), second = manifest(b);
        first.erase("execution");
        second.erase("execution");
        EXPECT_EQ(first, second) << nlohmann::ordered_json::diff(first, second).dump(2);
        for (const char* list : {"outputs", "debug_meshes"}) {
            ASSERT_FALSE(first[list].empty()) << list;
            for (const nlohmann::ordered_json& file : first[list]) {
                const std::string name = file["file"];
                EXPECT_EQ(contents(path() / a / name), contents(path() / b / name)) << name;
            }
        }
    }
};

} // namespace foam::test
