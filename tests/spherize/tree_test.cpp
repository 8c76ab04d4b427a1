// Sphere trees of every spherizer that makes them: a look-up that goes down from the root and leaves out what a parent
// does not reach must miss nothing.
#include "all_spherizers.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;
using namespace foam::test;

bool holds(const Sphere& sphere, const Vec3& point, double slack) {
    return distance(point, sphere.center) <= sphere.radius + slack;
}

/// Whether the point lies in a sphere of the finest level whose ancestors all hold it.
bool reached(const SphereTree& tree, const Vec3& point, double slack) {
    std::vector<char> above{1}; // of the spheres of a level: reached, and the point is inside
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        const SphereTree::Level& level = tree.levels[l];
        std::vector<char> here(level.elements.spheres().size());
        for (std::size_t i = 0; i < level.elements.spheres().size(); ++i) {
            here[i] = above[l == 0 ? 0 : level.parents[i]] && holds(level.elements.spheres()[i], point, slack);
        }
        above = std::move(here);
    }
    return std::count(above.begin(), above.end(), 1) > 0;
}

class Tree : public testing::TestWithParam<std::string> {
protected:
    SphereTree tree_of(const std::shared_ptr<const Solid>& solid, std::int64_t depth) {
        std::map<std::string, ParameterValue> parameters{{"depth", depth}};
        if (has_parameter(*all_spherizers().find(GetParam()), "branch")) {
            parameters["branch"] = std::int64_t{4};
        }
        if (has_parameter(*all_spherizers().find(GetParam()), "maxOptLevel")) {
            parameters["maxOptLevel"] = std::int64_t{2}; // what is improved must keep the promise too
        }
        QuietContext context;
        return all_spherizers().make<Spherizer>(GetParam(), parameters)->spherize({"part", solid, solid}, {}, context);
    }
};

TEST_P(Tree, LevelsEncloseCoverAndLeadToEveryPoint) {
    for (const std::string name : {"Box", "Bracket", "OpenCup", "TwoBoxes"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        const double size = solid->bounds().diagonal();
        const SphereTree tree = tree_of(solid, 3);
        ASSERT_EQ(tree.levels.size(), 4u);
        ASSERT_EQ(tree.levels[0].elements.spheres().size(), 1u);
        for (const Vec3& vertex : solid->surface().vertices) {
            EXPECT_TRUE(holds(tree.levels[0].elements.spheres()[0], vertex, 1e-9 * size)) << "level 0 does not enclose";
        }
        for (std::size_t l = 1; l < tree.levels.size(); ++l) {
            const std::vector<Sphere>& spheres = tree.levels[l].elements.spheres();
            EXPECT_GE(spheres.size(), tree.levels[l - 1].elements.size());
            const std::vector<Sphere> grown = grown_to_cover(*solid, spheres);
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                EXPECT_LE(grown[i].radius - spheres[i].radius, 0.02 * size) << "level " << l << " does not cover";
            }
        }
        std::size_t missed = 0;
        for (const SurfacePoint& sample : solid->sample_surface(2'000, 3)) {
            missed += !reached(tree, sample.point, 0.01 * size);
        }
        EXPECT_EQ(missed, 0u) << "points of the surface that the walk from the root does not reach";
    }
}

INSTANTIATE_TEST_SUITE_P(Spherizers, Tree, testing::ValuesIn(spherizer_names("depth")),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

} // namespace
