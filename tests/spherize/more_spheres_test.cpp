// A number of spheres for one link, whatever the spherizer: with one more the link never claims more, and never are
// there gaps. Measured on the file that was written.
#include "all_spherizers.hpp"
#include "support/runs.hpp"

#include <foam/geometry/volumes.hpp>

namespace {

using namespace foam;
using namespace foam::test;

class MoreSpheres : public RunTest, public testing::WithParamInterface<std::string> {
protected:
    MoreSpheres() {
        write("hook.urdf", R"(<robot name="hook"><link name="hook">
                    <collision><geometry><box size="0.3 0.05 0.1"/></geometry></collision>
                    <collision><origin xyz="0.125 0.1 0"/><geometry><box size="0.05 0.2 0.1"/></geometry></collision>
                    <collision><origin xyz="0.05 0.2 0"/><geometry><cylinder radius="0.03" length="0.2"/></geometry>
                    </collision>
                  </link></robot>)");
    }

    /// With the trees of earlier calls in a cache of the test's own.
    std::vector<Sphere> written(const std::string& budget, const std::string& refiners = ", refine.row, refine.split") {
        RunOptions with = options();
        with.fresh = false;
        with.cache = folder.path() / "cache";
        const Recipe recipe = recipe_of("name: hook\nrobot: {urdf: hook.urdf}\nstages: [" + GetParam() + refiners + "]\n" +
                                        budget + "\noutputs: [write.urdf: {file: hook.urdf}]\n");
        EXPECT_TRUE(run(recipe, registry, with).certified) << budget;
        return spheres_in("out/hook.urdf").at("hook");
    }
};

TEST_P(MoreSpheres, NeverClaimMore) {
    double least = std::numeric_limits<double>::infinity(), first = 0;
    for (std::size_t count = 1; count <= 18; ++count) {
        const std::vector<Sphere> spheres = written("budget: {spheres: " + std::to_string(count) + "}");
        EXPECT_LE(spheres.size(), count);
        const double claimed = exact_union_volume(spheres);
        // What is written is rounded to about a millionth of the link's size.
        EXPECT_LE(claimed, least * (1 + 1e-5)) << count;
        least = std::min(least, claimed);
        first = std::max(first, claimed);
    }
    EXPECT_LT(least, 0.7 * first);
}

TEST_P(MoreSpheres, AreTheSameByTheLinkAndByTheBudget) {
    EXPECT_EQ(written("links: {hook: {max_spheres: 9}}"), written("budget: {spheres: 9}"));
}

TEST_P(MoreSpheres, OrWhatTheSpherizerSaysToTheNumber) {
    const std::string budget = "links: {hook: {max_spheres: 11}}";
    const std::vector<Sphere> said = written(budget, "");
    EXPECT_LE(said.size(), 11u);
    if (GetParam() == "spherize.medial") { // 8 of its spheres with three of them split are others
        EXPECT_NE(said, written(budget));
    }
}

INSTANTIATE_TEST_SUITE_P(Spherizers, MoreSpheres, testing::ValuesIn(spherizer_names()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

} // namespace
