// Refiners in recipes, and what each of foam's does.
#include "support/runs.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/runtime/contract.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using namespace foam;
using namespace foam::test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

std::shared_ptr<const Solid> solid_of(const Element& primitive) {
    Solid::Part part;
    part.primitive = primitive;
    return Solid::make({part});
}

SphereTree around(const Solid& solid) {
    return flat_tree({minimum_enclosing_sphere(solid.surface().vertices)});
}

class Refiners : public RunTest {
protected:
    Refiners() {
        write("box.urdf", R"(<robot name="box"><link name="box">
                    <collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision></link></robot>)");
    }

    SphereTree refined(const std::string& stage, const std::shared_ptr<const Solid>& solid, const SphereTree& tree,
                       std::size_t most, const RefinementGoal& goal = {}) const {
        const Shape shape("part", solid, solid);
        QuietContext context;
        return registry.make<Refiner>(stage)->begin(shape, goal)->refine(tree, most, context);
    }
    std::vector<std::string> findings(const std::string& stages) {
        std::vector<std::string> texts;
        for (const Diagnostic& finding :
             parse_recipe("foam: 1\nmesh: a.stl\nstages: " + stages + "\n", "r.yaml", registry).diagnostics) {
            texts.push_back(finding.text());
        }
        return texts;
    }
};

TEST_F(Refiners, WithoutThemARecipeHasTheSpherizersSpheres) {
    const std::string text = "name: box\nrobot: {urdf: box.urdf}\nstages: [spherize.octree]\nbudget: {spheres: 7}\n"
                             "outputs: [write.urdf: {file: box.urdf}]\n";
    run(recipe_of(text), registry, options());
    const auto solid = solid_of(Element::box({0.4, 0.2, 0.1}));
    QuietContext context;
    const SphereTree made = registry.make<Spherizer>("spherize.octree")
                                ->spherize({"box", solid, solid}, {7, {}, Guarantee::outer}, context);
    const std::vector<Sphere> written = spheres_in("out/box.urdf").at("box");
    ASSERT_EQ(written.size(), made.finest().size());
    for (std::size_t i = 0; i < written.size(); ++i) {
        EXPECT_NEAR(distance(written[i].center, made.finest()[i].center), 0, 1e-6);
        EXPECT_NEAR(written[i].radius, made.finest()[i].radius, 1e-5);
    }
}

TEST_F(Refiners, AreInTheManifestInTheirOrder) {
    run(recipe_of("name: box\nrobot: {urdf: box.urdf}\nstages: [spherize.octree, refine.row, refine.split]\n"
                  "budget: {spheres: 7}\noutputs: [write.urdf: {file: box.urdf}]\n"),
        registry, options());
    const Json manifest = Json::parse(text_of("out/manifest.json"));
    std::vector<std::string> stages;
    for (const Json& stage : manifest["links"][0]["stages"]) {
        stages.push_back(stage["stage"]);
    }
    EXPECT_THAT(std::vector(stages.begin(), stages.begin() + 3),
                ElementsAre("spherize.octree", "refine.row", "refine.split"));
}

TEST_F(Refiners, StandAfterTheSpherizerOnce) {
    EXPECT_THAT(findings("[refine.split, spherize.octree]"),
                ElementsAre("r.yaml:3:10: error[wrong-kind]: 'refine.split' is a refiner before the spherizer; remedy: "
                            "move it after the spherizer"));
    EXPECT_THAT(findings("[spherize.octree, refine.split, refine.split]"),
                ElementsAre("r.yaml:3:41: error[duplicate-stage]: 'refine.split' is given twice; remedy: delete one"));
    EXPECT_THAT(findings("[spherize.octree, refine.split, repair.auto]"),
                ElementsAre("r.yaml:3:41: error[wrong-kind]: 'repair.auto' is a mesh filter after the spherizer "
                            "'spherize.octree'; remedy: move it before the spherizer"));
}

TEST_F(Refiners, SplitAddsSpheresUpToTheBudget) {
    const auto solid = solid_of(Element::box({0.4, 0.1, 0.1}));
    const SphereTree one = around(*solid);
    const SphereTree four = refined("refine.split", solid, one, 4);
    EXPECT_EQ(four.finest().size(), 4u);
    EXPECT_LT(geometry::joint_volume(*solid, grown_to_cover(*solid, four.finest())),
              0.5 * geometry::joint_volume(*solid, one.finest()));
    EXPECT_EQ(refined("refine.split", solid, one, 1).finest(), one.finest());
    for (const RefinementGoal& other :
         {RefinementGoal{.guarantee = Guarantee::inner}, RefinementGoal{.objective = Objective::radius},
          RefinementGoal{.objective = {}}, RefinementGoal{.max_protrusion = 0.01}}) {
        EXPECT_EQ(refined("refine.split", solid, one, 4, other).finest(), one.finest());
    }
}

TEST_F(Refiners, RowCoversACylinderByEqualSpheres) {
    const auto solid = solid_of(Element::cylinder(0.1, 1));
    const SphereTree row = refined("refine.row", solid, around(*solid), 5);
    ASSERT_EQ(row.finest().size(), 5u);
    for (const Sphere& sphere : row.finest()) {
        EXPECT_EQ(sphere.radius, row.finest()[0].radius);
        EXPECT_NEAR(sphere.center.x, 0, 1e-12);
    }
    EXPECT_TRUE(certify(*solid, grown_to_cover(*solid, row.finest())).holds);
    EXPECT_EQ(refined("refine.row", solid, row, 5).finest(), row.finest()) << "nothing is better";
}

TEST_F(Refiners, FitReducesTheSymmetricDifference) {
    const auto solid = solid_of(Element::box({0.4, 0.1, 0.1}));
    const SphereTree start = around(*solid);
    EXPECT_EQ(refined("refine.fit", solid, start, 3).finest(), start.finest()) << "only with guarantee fitted";
    const SphereTree fitted = refined("refine.fit", solid, start, 3, {.guarantee = Guarantee::fitted});
    EXPECT_LE(fitted.finest().size(), 3u);
    const auto difference = [&](const std::vector<Sphere>& spheres) {
        const Measures m = measure(*solid, spheres);
        return m.excess + m.missing;
    };
    EXPECT_LT(difference(fitted.finest()), 0.2 * difference(start.finest()));
}

TEST_F(Refiners, FitKeepsItsLargestGap) {
    const auto solid = solid_of(Element::box({0.4, 0.1, 0.1}));
    const auto fit = registry.make<Refiner>("refine.fit", {{"max_gap", ParameterValue(0.01)}});
    const Shape shape("part", solid, solid);
    QuietContext context;
    const SphereTree tree = fit->begin(shape, {.guarantee = Guarantee::fitted})->refine(around(*solid), 2, context);
    EXPECT_LE(measure(*solid, tree.finest()).gap, 0.01);
}

TEST_F(Refiners, FitRefusesWhatContradicts) {
    const auto refusal = [&](const std::map<std::string, ParameterValue>& given, const RefinementGoal& goal) {
        const auto solid = solid_of(Element::box({0.4, 0.1, 0.1}));
        try {
            registry.make<Refiner>("refine.fit", given)->begin(Shape("part", solid, solid), goal);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const RefinementGoal fitted{.guarantee = Guarantee::fitted};
    RefinementGoal clipped = fitted;
    clipped.clip = {{}};
    EXPECT_THAT(refusal({{"missing", 0.0}, {"distance", 0.0}, {"gap", 0.0}}, fitted),
                HasSubstr("no sphere at all is best; remedy: give one of them a weight"));
    EXPECT_THAT(refusal({{"max_gap", 0.01}}, clipped), HasSubstr("remedy: delete 'clip' of the link, or 'max_gap'"));
    EXPECT_EQ(refusal({}, clipped), "");
    EXPECT_THAT(refusal({{"max_gap", 0.01}}, {}), HasSubstr("remedy: write guarantee: fitted, or delete it"));
    EXPECT_EQ(refusal({}, {}), "");
}

TEST_F(Refiners, AnObjectiveIsRefusedWithGuaranteeFitted) {
    const char* stages = "[{spherize.cover: {objective: protrusion}}, refine.fit]";
    EXPECT_THAT(findings(stages), IsEmpty());
    EXPECT_THAT(findings(std::string(stages) + "\nguarantee: fitted"),
                ElementsAre(HasSubstr("r.yaml:3:28: error[conflict]: 'objective' of spherize.cover is what covering "
                                      "spheres make least: it has no effect with guarantee: fitted; remedy: delete")));
    EXPECT_THAT(findings("[spherize.cover, refine.fit]\nguarantee: fitted\nlinks: {'*': {spherize.cover: {objective: "
                         "radius}}}"),
                ElementsAre(HasSubstr("it has no effect with guarantee: fitted")));
}

TEST_F(Refiners, ClipKeepsTheConstraints) {
    const auto solid = solid_of(Element::box({0.4, 0.4, 0.1}));
    const ClipPlane table{{0, 0, -1}, 0.05, 0.02};
    const SphereTree clipped = refined("refine.clip", solid, around(*solid), 16, {.clip = {table}});
    const std::vector<Sphere> grown = grown_to_cover(*solid, clipped.finest());
    EXPECT_LE(clipped.finest().size(), 16u);
    EXPECT_LE(reach_beyond(table, grown), table.reach);
    EXPECT_TRUE(certify(*solid, grown).holds);
}

} // namespace
