// Objectives of spherize.cover through whole runs: what is written is proved, and what a run does to the spheres of a
// link does not undo them.
#include "geometry/measure_parts.hpp"
#include "support/temporary_folder.hpp"

#include <foam/host/registry.hpp>
#include <foam/host/run.hpp>
#include <foam/measure.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace {

using namespace foam;

class ObjectiveRuns : public testing::Test {
protected:
    ObjectiveRuns() { registry.load_directory(FOAM_TEST_PLUGINS); }

    /// The spheres of a robot of one link as they are read back. `geometry`: of the link, as URDF has it.
    std::vector<Sphere> written(const std::string& geometry, const std::string& parameters, std::size_t spheres) {
        std::ofstream(folder.path() / "rod.urdf") << R"(<robot name="rod"><link name="rod"><collision><geometry>)"
                                                  << geometry << "</geometry></collision></link></robot>";
        const std::string text = "foam: 1\nname: rod\nrobot: {urdf: rod.urdf}\nstages: [spherize.cover: {" +
                                 parameters + "}]\nbudget: {spheres: " + std::to_string(spheres) +
                                 "}\noutputs:\n  - write.urdf: {file: rod.urdf}\n";
        const RecipeResult recipe = parse_recipe(text, folder.path() / "rod.yaml", registry);
        EXPECT_TRUE(recipe.ok()) << recipe.diagnostics.at(0).text();
        RunOptions options;
        options.out = folder.path() / "out";
        options.fresh = true;
        EXPECT_TRUE(run(recipe.recipes.at(0), registry, options).certified);
        std::ostringstream urdf;
        urdf << std::ifstream(folder.path() / "out/rod.urdf").rdbuf();
        return registry.make<Writer>("write.urdf")->read(urdf.str()).at("rod");
    }

    TemporaryFolder folder;
    Registry registry;
};

std::shared_ptr<const Solid> solid_of(const Primitive& primitive) {
    return Solid::make(std::vector<Solid::Part>{{nullptr, primitive, Pose{}}});
}

TEST_F(ObjectiveRuns, EveryObjectiveAndEffortIsProvedAsWritten) {
    const auto box = solid_of({Primitive::Kind::box, {0.1, 0.2, 0.4}, 0, 0});
    for (const std::string objective : {"excess", "protrusion", "radius"}) {
        for (const std::string effort : {"fast", "normal", "best"}) {
            SCOPED_TRACE(objective + ", " + effort);
            const std::vector<Sphere> spheres =
                written(R"(<box size="0.1 0.2 0.4"/>)", "objective: " + objective + ", effort: " + effort, 3);
            EXPECT_LE(spheres.size(), 3u);
            EXPECT_TRUE(certify(*box, spheres).holds);
        }
    }
}

/// A row of equal spheres claims less than what protrudes least, which has smaller spheres at the ends.
TEST_F(ObjectiveRuns, SpheresThatClaimLessDoNotStandInForThoseAskedFor) {
    const auto rod = solid_of({Primitive::Kind::cylinder, {}, 0.1, 0.5});
    const auto protrusion = [&](const std::string& objective) {
        const std::vector<Sphere> spheres =
            written(R"(<cylinder radius="0.1" length="0.5"/>)", "effort: fast, objective: " + objective, 9);
        return geometry::protrusion(*rod, spheres, MeasureOptions{}.directions_per_sphere).max;
    };
    EXPECT_LT(protrusion("protrusion"), 0.9 * protrusion("excess"));
}

} // namespace
