// Objectives of spherize.cover through whole runs: what is written is proved, and what a run does to the spheres of a
// link does not undo them.
#include "support/runs.hpp"

#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/search/spherize.hpp>

#include <numeric>

namespace {

using namespace foam;

class ObjectiveRuns : public test::RunTest {
protected:
    /// The spheres of a robot as they are read back. `geometries`: of its links a, b, …, as URDF has them.
    std::map<std::string, std::vector<Sphere>> written(const std::vector<std::string>& geometries,
                                                       const std::string& parameters, std::size_t spheres) {
        std::string urdf = "<robot name=\"robot\">", name = "a";
        for (const std::string& geometry : geometries) {
            urdf += "<link name=\"" + name + "\"><collision><geometry>" + geometry + "</geometry></collision></link>";
            if (name != "a") {
                urdf += "<joint name=\"j" + name + "\" type=\"fixed\"><parent link=\"a\"/><child link=\"" + name +
                        "\"/></joint>";
            }
            ++name[0];
        }
        write("robot.urdf", urdf + "</robot>");
        const Recipe recipe = recipe_of("name: robot\nrobot: {urdf: robot.urdf}\nstages: [spherize.cover: {" +
                                        parameters + "}]\nbudget: {spheres: " + std::to_string(spheres) +
                                        "}\noutputs:\n  - write.urdf: {file: robot.urdf}\n");
        EXPECT_TRUE(run(recipe, registry, options()).certified);
        return spheres_in("out/robot.urdf");
    }
};

std::shared_ptr<const Solid> solid_of(const Element& primitive) {
    return Solid::make(std::vector<Solid::Part>{{nullptr, primitive, Pose{}}});
}

TEST_F(ObjectiveRuns, EveryObjectiveAndEffortIsProvedAsWritten) {
    const auto box = solid_of(Element::box({0.1, 0.2, 0.4}));
    for (const std::string objective : {"excess", "protrusion", "radius"}) {
        for (const std::string effort : {"fast", "normal", "best"}) {
            SCOPED_TRACE(objective + ", " + effort);
            const std::vector<Sphere> spheres =
                written({R"(<box size="0.1 0.2 0.4"/>)"}, "objective: " + objective + ", effort: " + effort, 3).at("a");
            EXPECT_LE(spheres.size(), 3u);
            EXPECT_TRUE(certify(*box, spheres).holds);
        }
    }
}

double protrusion_of(const Solid& solid, const std::vector<Sphere>& spheres) {
    return geometry::protrusion(solid, spheres, MeasureOptions{}.directions_per_sphere).max;
}

double largest_radius(const Solid&, const std::vector<Sphere>& spheres) {
    double largest = 0;
    for (const Sphere& sphere : spheres) {
        largest = std::max(largest, sphere.radius);
    }
    return largest;
}

/// A row of equal spheres claims less than what protrudes least, which has smaller spheres at the ends.
TEST_F(ObjectiveRuns, SpheresThatClaimLessDoNotStandInForThoseAskedFor) {
    const auto rod = solid_of(Element::cylinder(0.1, 0.5));
    const auto protrusion = [&](const std::string& objective) {
        return protrusion_of(
            *rod,
            written({R"(<cylinder radius="0.1" length="0.5"/>)"}, "effort: fast, objective: " + objective, 9).at("a"));
    };
    EXPECT_LT(protrusion("protrusion"), 0.9 * protrusion("excess"));
}

/// Of all ways to share them that with the best worst link.
TEST_F(ObjectiveRuns, ANumberForTheRobotGoesWhereTheWorstIs) {
    const auto plate = solid_of(Element::box({0.6, 0.5, 0.05}));
    const auto block = solid_of(Element::box({0.2, 0.3, 0.4}));
    constexpr std::size_t most = 9;
    std::vector<std::size_t> counts(most - 1);
    std::iota(counts.begin(), counts.end(), std::size_t{1});
    for (const std::string objective : {"protrusion", "radius"}) {
        SCOPED_TRACE(objective);
        const auto figure = objective == "radius" ? largest_radius : protrusion_of;
        const CoverOptions options{.effort = Effort::fast,
                                      .objective = objective == "radius" ? Objective::radius : Objective::protrusion};
        const std::vector<SphereCover> of_plate = spherize_each(*plate, counts, options);
        const std::vector<SphereCover> of_block = spherize_each(*block, counts, options);
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < counts.size(); ++i) {
            best = std::min(best, std::max(figure(*plate, of_plate[i].spheres),
                                           figure(*block, of_block[counts.size() - 1 - i].spheres)));
        }
        const auto robot = written({R"(<box size="0.6 0.5 0.05"/>)", R"(<box size="0.2 0.3 0.4"/>)"},
                                   "effort: fast, objective: " + objective, most);
        const double worst = std::max(figure(*plate, robot.at("a")), figure(*block, robot.at("b")));
        EXPECT_NEAR(worst, best, 0.02 * best) << "seeds of links differ";
        const auto by_excess =
            written({R"(<box size="0.6 0.5 0.05"/>)", R"(<box size="0.2 0.3 0.4"/>)"}, "effort: fast", most);
        EXPECT_LT(worst, std::max(figure(*plate, by_excess.at("a")), figure(*block, by_excess.at("b"))));
    }
}

} // namespace
