// spherize.medial against the runs of the original tool, at the same number of spheres on every link: no more excess,
// and proved. Prints the figures and the CPU seconds of both; the original's include no measuring, ours do.
#include "corpus/whole_run.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace foam {
namespace {

namespace fs = std::filesystem;

struct Reference {
    std::string robot, setting; ///< as results.csv has them
    std::string urdf;           ///< that the original was run on
};

void PrintTo(const Reference& reference, std::ostream* out) {
    *out << reference.robot << " " << reference.setting;
}

const std::string panda = "panda/foam_variant/panda.urdf";
const std::vector<Reference> references{
    {"panda", "d0_t1", panda},
    {"panda", "d1_b2_t1", panda},
    {"panda", "d1_b3_t1", panda},
    {"panda", "d1_b8_t1", panda},
    {"panda", "d1_b8_r100_t1", panda},
    {"panda", "d2_b8_t1", panda},
    {"panda", "d3_b8_t1", panda},
    {"fetch", "default_t1", "fetch/fetch_description/fetch_foam.urdf"},
    {"baxter", "default_t1", "baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf"},
};

struct Figures {
    double cpu_seconds, excess;
};

/// The row of results.csv: robot,setting,flags,threads,spheres,user_s,wall_s,covered,gap_mm,excess,…
Figures figures_of(const fs::path& table, const Reference& reference) {
    std::ifstream in(table);
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) {
            cells.push_back(cell);
        }
        if (cells.size() > 9 && cells[0] == reference.robot && cells[1] == reference.setting) {
            return {std::stod(cells[5]), std::stod(cells[9])};
        }
    }
    throw Error(ErrorCode::input, table.string() + " has no row " + reference.robot + "," + reference.setting);
}

class SameCounts : public ::testing::TestWithParam<Reference> {};

TEST_P(SameCounts, ClaimsNoMoreThanTheOriginal) {
    const Reference& reference = GetParam();
    const fs::path runs = shared_folder() / "reference_spheres/foam_runs";
    const fs::path spheres = runs / (reference.robot + "_" + reference.setting + ".spheres.json");
    const fs::path urdf = shared_folder() / "robots" / reference.urdf;
    if (!fs::exists(spheres) || !fs::exists(urdf)) {
        GTEST_SKIP() << spheres << " or " << urdf << " is not there";
    }
    const auto links = nlohmann::json::parse(std::ifstream(spheres)).at("spheres");
    std::string budgets;
    for (const auto& [link, list] : links.items()) {
        budgets += "  " + link + ": {max_spheres: " + std::to_string(list.size()) + "}\n";
    }
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    const TemporaryFolder folder;
    const RunResult result = run_text(
        "robot: {urdf: '" + urdf.string() +
            "'}\nstages: [repair.auto, simplify.quadric, smooth.humphrey, spherize.medial]\nlinks:\n" + budgets,
        registry, folder.path() / "out");
    const Figures original = figures_of(runs / "results.csv", reference);
    std::cout << std::fixed << std::setprecision(3) << "| " << reference.robot << " " << reference.setting << " | "
              << result.total.spheres << " | " << original.excess << " | " << result.total.excess << " | "
              << original.cpu_seconds << " | " << result.cpu_seconds << " |\n";
    EXPECT_TRUE(result.certified);
    EXPECT_LE(result.total.excess, original.excess);
    for (const LinkReport& link : result.links) {
        EXPECT_LE(link.measures.spheres, links.at(link.link).size()) << link.link;
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, SameCounts, ::testing::ValuesIn(references),
                         [](const auto& test) { return test.param.robot + "_" + test.param.setting; });

} // namespace
} // namespace foam
