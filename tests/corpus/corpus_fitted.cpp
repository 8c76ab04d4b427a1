// Guarantee fitted by volumes alone, on the collision meshes of the Panda against MorphIt with as many spheres on each:
// what is claimed wrongly and what is left out, together. Prints the figures and the CPU seconds of both; those of
// MorphIt include no measuring, ours do.
#include "corpus/whole_run.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace foam {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> meshes{"link0", "link1", "link2", "link3", "link4",
                                      "link5", "link6", "link7", "hand",  "finger"};

struct Figures {
    double cpu_seconds = 0, wrong = 0; ///< excess and missing, weighted by volume
};

/// Of MorphIt, from the table with rows of tool,mesh,preset,asked,got,seed,wall,user,covered,gap_mm,litres,excess,….
Figures morphit(const fs::path& table, std::size_t spheres) {
    std::ifstream in(table);
    Figures sum;
    double volume = 0;
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) {
            cells.push_back(cell);
        }
        if (cells.size() > 12 && cells[0] == "MorphIt" && cells[2] == "B" && cells[3] == std::to_string(spheres) &&
            cells[5] == "0" && std::find(meshes.begin(), meshes.end(), cells[1]) != meshes.end()) {
            sum.cpu_seconds += std::stod(cells[7]);
            sum.wrong += std::stod(cells[10]) * (std::stod(cells[11]) + std::stod(cells[12]));
            volume += std::stod(cells[10]);
        }
    }
    sum.wrong /= volume;
    return sum;
}

/// A robot of one link for each mesh.
void write_robot(const fs::path& file, const fs::path& folder) {
    std::ofstream urdf(file);
    urdf << "<robot name=\"meshes\">";
    for (const std::string& mesh : meshes) {
        urdf << "<link name=\"" << mesh << "\"><collision><geometry><mesh filename=\""
             << (folder / (mesh + ".obj")).string() << "\"/></geometry></collision></link>";
        if (mesh != meshes.front()) {
            urdf << "<joint name=\"to_" << mesh << "\" type=\"fixed\"><parent link=\"" << meshes.front()
                 << "\"/><child link=\"" << mesh << "\"/></joint>";
        }
    }
    urdf << "</robot>";
}

class FittedPanda : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FittedPanda, IsWrongByAFifthLessThanMorphIt) {
    const fs::path folder = shared_folder() / "robots/panda/foam_variant/meshes/collision";
    const fs::path table = shared_folder() / "reference_spheres/peer_runs/results.csv";
    if (!fs::exists(folder / "link0.obj") || !fs::exists(table)) {
        GTEST_SKIP() << folder << " or " << table << " is not there";
    }
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    const TemporaryFolder own;
    write_robot(own.path() / "meshes.urdf", folder);
    const RunResult result = run_text("robot: {urdf: '" + (own.path() / "meshes.urdf").string() +
                                          "'}\nstages: [spherize.cover, {refine.fit: {missing: 1, distance: 0, gap: "
                                          "0}}]\nguarantee: fitted\nlinks: {'*': {max_spheres: " +
                                          std::to_string(GetParam()) + "}}\n",
                                      registry, own.path() / "out");
    const Figures theirs = morphit(table, GetParam());
    const double ours = result.total.excess + result.total.missing;
    std::cout << std::fixed << std::setprecision(3) << "| " << GetParam() << " | " << theirs.wrong << " | " << ours
              << " | " << theirs.cpu_seconds << " | " << result.cpu_seconds << " |\n";
    EXPECT_LE(result.total.spheres, meshes.size() * GetParam());
    EXPECT_LT(ours, 0.8 * theirs.wrong);
}

INSTANTIATE_TEST_SUITE_P(Shared, FittedPanda, ::testing::Values(2, 8, 20),
                         [](const auto& test) { return std::to_string(test.param) + "_a_mesh"; });

} // namespace
} // namespace foam
