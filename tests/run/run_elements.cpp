// Elements of any kind through a whole run: what a third party's stage makes is grown, proved, written and recorded.
#include "small_robot.hpp"

#include <foam/geometry/measure.hpp>

#include <nlohmann/json.hpp>

namespace foam {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;

class RunElements : public Run {
protected:
    RunElements() { registry.load(FOAM_TEST_BY_HAND); }

    /// A run of approximate.by_hand with these parameters.
    RunResult made(const std::string& parameters, const std::string& rest = "budget: {elements: 6}\n",
                   const std::string& out = "out") {
        RunOptions as_usual = options(out);
        as_usual.report = true;
        return run(recipe("stages: [approximate.by_hand: {" + parameters + "}]\noutputs: [write.by_hand]\n" + rest),
                   registry, as_usual);
    }
    json manifest(const std::string& out = "out") const { return json::parse(text_of(out + "/manifest.json")); }
    /// The elements of a link, as the files hold them.
    Elements read_back(const std::string& link, const std::string& out = "out") const {
        std::map<std::string, std::string> beside;
        for (const auto& file : std::filesystem::directory_iterator(folder.path() / out)) {
            for (const auto& hull : file.path().filename() == "hulls" ? std::filesystem::directory_iterator(file.path())
                                                                      : std::filesystem::directory_iterator()) {
                beside["hulls/" + hull.path().filename().string()] =
                    text_of(out + "/hulls/" + hull.path().filename().string());
            }
        }
        return registry.make<Writer>("write.by_hand")->read(text_of(out + "/two.hand"), beside).at(link);
    }
};

/// The base of two.urdf.
std::shared_ptr<const Solid> base() {
    Pose pose;
    pose.translation = {0, 0, 0.1};
    return Solid::make(
        std::vector<Solid::Part>{{nullptr, Element::box({0.4, 0.2, 0.2}), pose}});
}

TEST_F(RunElements, OfEveryKindAreProvedOnTheNumbersReadBack) {
    for (const char* kind : {"capsule", "cylinder", "box", "swept_box", "hull", "ellipsoid", "each"}) {
        for (const char* turned : {"false", "true"}) {
            const std::string parameters = std::string("kind: ") + kind + ", turned: " + turned;
            SCOPED_TRACE(parameters);
            const RunResult result = made(parameters);
            EXPECT_TRUE(result.certified);
            const Elements level = read_back("base");
            EXPECT_EQ(result.total.spheres, level.size() + read_back("tip").size());
            EXPECT_LE(result.total.spheres, 6u);
            if (result.total.spheres < 6u) {
                EXPECT_THAT(warnings_of(result), Contains(HasSubstr("more elements did not reduce the excess")));
            }
            EXPECT_TRUE(certify(*base(), level).holds);
            EXPECT_GT(level.shaped().size(), 0u);
        }
    }
}

TEST_F(RunElements, ThatFallShortGrow) {
    for (const char* kind : {"capsule", "cylinder", "box", "swept_box", "hull", "ellipsoid", "each"}) {
        SCOPED_TRACE(kind);
        const RunResult result = made(std::string("kind: ") + kind + ", short_by: 0.05");
        EXPECT_TRUE(result.certified);
        EXPECT_GT(result.links[0].growth, 1e-4);
        EXPECT_TRUE(certify(*base(), read_back("base")).holds);
    }
}

TEST_F(RunElements, AreProvedInSinglePrecisionToo) {
    const RunResult result = made("turned: true", "budget: {elements: 12}\nnumbers: float32\n");
    EXPECT_TRUE(result.certified);
    const json outputs = manifest()["outputs"];
    ASSERT_FALSE(outputs[0]["proofs"].empty());
    for (const json& proof : outputs[0]["proofs"]) {
        EXPECT_TRUE(proof["float32"]);
    }
}

TEST_F(RunElements, OfTinyGeometryComeBackFromItsOwnFrame) {
    write("two.urdf", "<robot name=\"two\"><link name=\"base\"><collision><geometry><box size=\"4e-8 2e-8 3e-8\"/>"
                      "</geometry></collision></link></robot>");
    const RunResult result = made("", "budget: {elements: 6}\n");
    EXPECT_TRUE(result.certified);
    EXPECT_LT(result.total.excess, 60);
    EXPECT_EQ(result.links[0].kinds[static_cast<std::size_t>(Element::Kind::hull)], 1u);
}

TEST_F(RunElements, AreCountedByKindInTheManifest) {
    made("", "budget: {elements: 12}\n");
    const json links = manifest()["links"];
    std::size_t sum = 0;
    for (const json& link : links) {
        if (!link.contains("kinds")) { // spheres alone
            sum += link.at("measures").at("spheres").get<std::size_t>();
            continue;
        }
        for (const auto& [kind, count] : link.at("kinds").items()) {
            sum += count.get<std::size_t>();
        }
    }
    EXPECT_EQ(sum, manifest().at("total").at("spheres").get<std::size_t>());
    EXPECT_THAT(text_of("out/report.html"), HasSubstr("\"kind\":\"hull\""));
}

TEST_F(RunElements, FilesBesideAreRecorded) {
    const RunResult result = made("kind: hull", "budget: {elements: 4}\n");
    const json outputs = manifest()["outputs"];
    std::size_t hulls = 0;
    for (const json& file : outputs) {
        hulls += file.at("file").get<std::string>().starts_with("hulls/") ? 1 : 0;
    }
    EXPECT_EQ(hulls, result.total.spheres);
    EXPECT_GE(hulls, 2u);
}

TEST_F(RunElements, ComeFromTheCacheAsTheyWere) {
    RunOptions cached = options("first");
    cached.fresh = false;
    cached.cache = folder.path() / "cache";
    const Recipe twice = recipe("stages: [approximate.by_hand]\noutputs: [write.by_hand]\nbudget: {elements: 12}\n");
    run(twice, registry, cached);
    cached.out = folder.path() / "second";
    const RunResult again = run(twice, registry, cached);
    EXPECT_EQ(text_of("first/two.hand"), text_of("second/two.hand"));
    for (const LinkReport& link : again.links) {
        for (const StageReport& stage : link.stages) {
            EXPECT_TRUE(stage.stage != "approximate.by_hand" || stage.cached);
        }
    }
}

TEST_F(RunElements, CostAtMostWhatTheBudgetSays) {
    for (const double most : {8.0, 14.0, 40.0}) {
        const RunResult result = made("kind: box, turned: true", "budget: {cost: " + std::to_string(most) + "}\n");
        double cost = 0;
        for (const LinkReport& link : result.links) {
            cost += 4 * static_cast<double>(link.kinds[static_cast<std::size_t>(Element::Kind::box)]);
        }
        EXPECT_LE(cost, most);
        EXPECT_GE(cost, std::min(most - 3, 24.0)); // here more than some boxes do not reduce the excess
        EXPECT_TRUE(result.certified);
    }
    const RunResult cheaper = made("kind: box, turned: true", "budget: {cost: 8, costs: {box: 2}}\n");
    EXPECT_EQ(cheaper.total.spheres, 4u);
    code = ErrorCode::internal;
    EXPECT_THAT(failure("stages: [approximate.by_hand: {kind: box}]\nbudget: {cost: 5}\noutputs: [write.by_hand]\n"),
                AllOf(HasSubstr("budget.cost: 5 is not enough"), HasSubstr("remedy")));
    EXPECT_EQ(code, ErrorCode::recipe);
    // What a hull costs is known once it is made.
    EXPECT_THAT(failure("stages: [approximate.by_hand: {kind: hull}]\nbudget: {cost: 1}\noutputs: [write.by_hand]\n"),
                AllOf(HasSubstr("the cheapest elements found cost at least 1.6"), HasSubstr("remedy")));
}

TEST_F(RunElements, MoreNeverHaveMoreExcess) {
    double before = std::numeric_limits<double>::infinity();
    for (const std::size_t count : {2, 3, 5, 9}) {
        const RunResult result = made("kind: box, turned: true", "budget: {elements: " + std::to_string(count) + "}\n");
        EXPECT_LE(result.total.excess, before * (1 + 1e-9));
        before = result.total.excess;
    }
}

TEST_F(RunElements, AreApartInTheReferencePoseWhereTheyCan) {
    EXPECT_TRUE(made("kind: box", "budget: {elements: 6}\nself_collision: true\n").certified);
}

TEST_F(RunElements, AreRefusedWhereOnlySpheresAreKnown) {
    const auto finding = [&](const std::string& rest) {
        const RecipeResult result = parse_recipe("foam: 1\nname: two\nrobot: {urdf: two.urdf}\n" + rest,
                                                 folder.path() / "recipe.yaml", registry);
        return result.diagnostics.empty() ? std::string("nothing") : result.diagnostics.front().text();
    };
    EXPECT_THAT(finding("stages: [approximate.by_hand, refine.split]\noutputs: [write.by_hand]\n"),
                AllOf(HasSubstr("refine.split"), HasSubstr("spheres alone"), HasSubstr("remedy")));
    EXPECT_THAT(finding("stages: [approximate.by_hand]\nguarantee: inner\noutputs: [write.by_hand]\n"),
                AllOf(HasSubstr("only spheres are proved to lie inside"), HasSubstr("remedy")));
    EXPECT_THAT(finding("stages: [approximate.by_hand]\nbudget: {elements: 3, spheres: 4}\noutputs: [write.by_hand]\n"),
                AllOf(HasSubstr("both 'spheres' and 'elements'"), HasSubstr("remedy")));
    EXPECT_THAT(finding("stages: [approximate.by_hand]\nbudget: {costs: {box: 4}}\noutputs: [write.by_hand]\n"),
                AllOf(HasSubstr("'costs' has no effect"), HasSubstr("remedy")));
}

TEST_F(RunElements, OfAKindThatAFileDoesNotHoldAreNotWritten) {
    code = ErrorCode::internal;
    EXPECT_THAT(failure("stages: [approximate.by_hand: {kind: hull}]\nbudget: {elements: 4}\noutputs: [write.csv]\n"),
                AllOf(HasSubstr("write.csv"), HasSubstr("hull"), HasSubstr("remedy")));
    EXPECT_EQ(code, ErrorCode::output);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(RunElements, OfGuaranteeFittedStayAsTheyAre) {
    const RunResult result = made("kind: box, short_by: 0.1", "budget: {elements: 4}\nguarantee: fitted\n");
    EXPECT_FALSE(result.certified);
    EXPECT_LT(result.links[0].growth, 1e-6);
    EXPECT_GT(result.total.missing, 0.1);
}

TEST_F(RunElements, ArePadded) {
    const RunResult result = made("", "budget: {elements: 12}\npad: 0.01\n");
    EXPECT_TRUE(result.certified);
    EXPECT_GT(result.total.excess, result.total_unpadded->excess);
}

} // namespace
} // namespace foam
