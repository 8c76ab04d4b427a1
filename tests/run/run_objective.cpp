// What a stage declares as its objective, and what its chance comes from.
#include "small_robot.hpp"

namespace foam {
namespace {

class Aiming : public Run {
protected:
    Aiming() { registry.load(FOAM_TEST_AIMING); }

    RunResult made(const std::string& parameters, const std::string& rest = "") {
        return run(recipe("stages: [spherize.aiming: {" + parameters +
                          "}, refine.split]\nlinks: {tip: {skip: true}}\nbudget: {spheres: 8}\n" + rest),
                   registry, options());
    }
    std::string written(const std::string& parameters, const std::string& rest = "") {
        made(parameters, rest);
        return read_file(folder.path() / "out/two.urdf");
    }
};

TEST_F(Aiming, SpheresThatClaimLessStandInWhereExcessIsTheObjective) {
    EXPECT_GT(made("aim: excess").total.spheres, 1u);
    EXPECT_GT(made("").total.spheres, 1u);
}

TEST_F(Aiming, SpheresOfAnotherObjectiveAreTakenAsTheyCome) {
    EXPECT_EQ(made("aim: roundness").total.spheres, 1u);
}

TEST_F(Aiming, ChanceComesFromTheRecipesSeedAndTheGeometry) {
    const std::string spheres = written("aim: roundness");
    EXPECT_EQ(written("aim: roundness, unused: 2"), spheres);
    EXPECT_NE(written("aim: roundness", "seed: 1\n"), spheres);
    write_file(folder.path() / "two.urdf",
               std::string(two_links).replace(std::string(two_links).find("0.4"), 3, "0.5"));
    EXPECT_NE(written("aim: roundness"), spheres);
}

} // namespace
} // namespace foam
