// configs/experiments: all are right, and every filter and spherizer is measured.
#include <foam/bench/experiment.hpp>
#include <foam/sdk/kinds.hpp>

#include <gtest/gtest.h>

#include <set>

namespace foam {
namespace {

class Shipped : public testing::Test {
protected:
    void SetUp() override { registry.load_directory(FOAM_TEST_PLUGINS); }

    std::unique_ptr<const Experiment> read(const std::string& file) const {
        ExperimentReading reading =
            read_experiment(std::filesystem::path(FOAM_TEST_SOURCE "/configs/experiments") / file, registry);
        for (const Diagnostic& finding : reading.diagnostics) {
            ADD_FAILURE() << finding.text();
        }
        return std::move(reading.experiment);
    }

    void expect_all(StageKind kind, const std::string& file) const {
        const auto experiment = read(file);
        ASSERT_TRUE(experiment);
        const std::set<std::string> measured = experiment->stages();
        for (const auto& [name, stage] : registry.stages()) {
            // Those of other elements are judged by docs/benchmarks/convex.py.
            EXPECT_TRUE(stage.kind != kind || !spheres_alone(stage.info.kinds) || measured.contains(name))
                << name << " is not measured; remedy: add it to configs/experiments/" << file;
        }
    }

    Registry registry;
};

TEST_F(Shipped, AllAreRight) {
    for (const auto& entry : std::filesystem::directory_iterator(FOAM_TEST_SOURCE "/configs/experiments")) {
        const auto experiment = read(entry.path().filename().string());
        ASSERT_TRUE(experiment);
        EXPECT_EQ(experiment->name, entry.path().stem().string());
    }
}

TEST_F(Shipped, EveryLoaderAndFilterIsTimed) {
    expect_all(StageKind::mesh_loader, "filters.yaml");
    expect_all(StageKind::mesh_filter, "filters.yaml");
}

TEST_F(Shipped, EverySpherizerIsTimed) {
    expect_all(StageKind::spherizer, "spherizers.yaml");
}

TEST_F(Shipped, EverySpherizerIsJudged) {
    expect_all(StageKind::spherizer, "methods.yaml");
}

} // namespace
} // namespace foam
