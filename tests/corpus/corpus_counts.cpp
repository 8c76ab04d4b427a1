// One more sphere around a mesh of many points never adds excess: there, spheres grow in the end by what splits of a
// coarse surface left open, some by more than others.
#include "corpus/whole_run.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace foam {
namespace {

namespace fs = std::filesystem;

struct Counts {
    std::string mesh;
    std::size_t from, to;
};

void PrintTo(const Counts& counts, std::ostream* out) {
    *out << counts.mesh << " by " << counts.from << " to " << counts.to << " spheres";
}

class CorpusCounts : public ::testing::TestWithParam<Counts> {};

TEST_P(CorpusCounts, NeverHaveMoreExcessWithMoreSpheres) {
    const fs::path file = shared_folder() / "meshes/real" / GetParam().mesh;
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const TemporaryFolder folder;
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t count = GetParam().from; count <= GetParam().to; ++count) {
        const RunResult result = run_text("mesh: '" + file.string() +
                                              "'\nstages: [spherize.cover: {effort: fast}, refine.split]\n" +
                                              "budget: {spheres: " + std::to_string(count) + "}\n",
                                          registry, folder.path() / std::to_string(count));
        EXPECT_TRUE(result.certified) << count;
        EXPECT_LE(result.total.excess, least * (1 + 2e-5)) << count;
        least = std::min(least, result.total.excess);
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusCounts,
                         ::testing::Values(Counts{"fandisk.obj", 34, 38}, Counts{"rocker-arm.obj", 27, 29}));

} // namespace
} // namespace foam
