// kind: element_checks. What a check of a pair of elements, and of a whole robot against itself, costs in collision
// libraries by the kind of the elements.
#include "element_checks.hpp"

#include "kinds.hpp"

#include <foam/runtime/internal/input.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;

class ElementChecks final : public Experiment {
public:
    std::vector<NamedRobot> robots;
    std::vector<Chain> methods;        ///< the first is what the others are compared with
    std::vector<std::size_t> elements; ///< a link
    std::vector<std::string> engines;
    std::size_t poses = 1000, pairs = 32, repeats = 8;
    std::uint64_t seed = 0;
    double time_limit = 600; ///< CPU s, of an engine on a model

    std::set<std::string> stages() const override {
        std::set<std::string> names;
        for (const Chain& method : methods) {
            add_names(method, names);
        }
        return names;
    }

    Outcome run(Bench& bench) const override {
        ElementCheckResults results{.engines = engines, .poses = poses, .pairs = pairs, .cases = {}, .missing = {}};
        results.missing = for_each_found(*this, bench, robots, [&](const NamedRobot& robot, const std::string&) {
            for (const std::size_t each : elements) {
                for (const Chain& method : methods) {
                    results.cases.push_back(measured(bench, robot, method, each));
                }
            }
        });
        return told(results);
    }

private:
    RunResult model_of(const Bench& bench, const NamedRobot& robot, const Chain& method, std::size_t each) const {
        Recipe recipe = recipe_of(*this, robot, &method);
        recipe.seed = seed;
        RunOptions options;
        options.cancel = bench.cancel();
        Journal journal(nullptr);
        const Cache no_cache{{}};
        const Input input = load_input({recipe, bench.registry(), options, journal, no_cache});
        recipe.budget_spheres =
            each * static_cast<std::size_t>(std::count_if(input.robot->links.begin(), input.robot->links.end(),
                                                          [](const Link& link) { return !link.collisions.empty(); }));
        return foam::run(recipe, bench.registry(), options);
    }

    ElementCase measured(Bench& bench, const NamedRobot& robot, const Chain& method, std::size_t each) const {
        const RunResult made = model_of(bench, robot, method, each);
        const std::vector<LinkSpheres> links = elements_by_link(made.model);
        const Kinematics kinematics(made.model.robot);
        const ElementRobot whole = element_robot(kinematics, links);
        ElementCase result{.robot = robot.name, .method = method.label, .each = each, .reports = {}};
        for (const LinkSpheres& link : links) {
            result.elements += link.elements.size();
            result.price += price_of(link.elements, ElementCost());
        }
        result.price /= static_cast<double>(result.elements);
        result.shape_pairs = shape_pairs(whole.robot);
        Random random(derive_seed(seed, "near pairs"));
        const NearPairs near(links, pairs, random);
        std::vector<EngineQuery> near_queries, whole_queries;
        for (std::size_t i = 0; i < poses; ++i) {
            near_queries.push_back(self_check(near.poses(random)));
            whole_queries.push_back(self_check(configuration(kinematics, whole, i)));
        }
        for (const std::string& engine : engines) {
            bench.check_cancelled();
            result.reports.push_back(
                {asked(bench, engine, near.robot(), near_queries), asked(bench, engine, whole.robot, whole_queries)});
            bench.tell(told_line(result, engine));
        }
        return result;
    }

    std::string told_line(const ElementCase& result, const std::string& engine) const {
        const ElementReports& reports = result.reports.back();
        return fmt::format("{}: {}, {}, {} elements, {}: {} ns a near pair, {} µs the robot", name, result.robot,
                           result.method, result.elements, engine,
                           short_number(1e9 * check_seconds(reports.near) / static_cast<double>(pairs)),
                           short_number(1e6 * whole_seconds(reports.whole)));
    }

    EngineQuery self_check(std::vector<Pose> at) const {
        EngineQuery query;
        query.poses = std::move(at);
        query.self_checks = static_cast<std::uint32_t>(repeats);
        return query;
    }

    /// The same for all models of a robot with the same links.
    std::vector<Pose> configuration(const Kinematics& kinematics, const ElementRobot& whole, std::size_t index) const {
        Random random(derive_seed(seed, fmt::format("configuration {}", index)));
        const std::vector<Pose> all = kinematics.link_poses(kinematics.random_configuration(random));
        std::vector<Pose> result;
        for (const std::size_t link : whole.links) {
            result.push_back(all[link]);
        }
        return result;
    }

    EngineReport asked(const Bench& bench, const std::string& engine, const EngineRobot& robot,
                       const std::vector<EngineQuery>& queries) const {
        EngineProblem problem;
        problem.engine = engine;
        problem.models = {robot, robot}; // each is measured: twice as many samples
        problem.environments = {{}};
        problem.queries = queries;
        problem.time_limit = time_limit;
        return ask_engine(std::move(problem), [&bench] { return bench.cancelled(); });
    }
};

const std::vector<Parameter>& check_values() {
    static const std::vector<Parameter> values{
        Parameter::integer("poses", 1000).bounds(1, 1e6),
        Parameter::integer("pairs", 32).bounds(1, 1000),
        Parameter::integer("repeats", 8).bounds(1, 1e6),
        Parameter::integer("seed", 0).bounds(0, 1e15),
        Parameter::number("time_limit", 600).bounds(0.01, 1e7).unit("s"),
    };
    return values;
}

} // namespace

std::unique_ptr<Experiment> read_element_checks(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<ElementChecks>();
    Findings& findings = checking.findings;
    const auto values = read_kind_values(root, check_values(), {"robots", "methods", "elements", "engines"}, checking);
    take(values, "poses", experiment->poses);
    take(values, "pairs", experiment->pairs);
    take(values, "repeats", experiment->repeats);
    take(values, "seed", experiment->seed);
    take(values, "time_limit", experiment->time_limit);
    experiment->engines = read_engines(root.find("engines"), findings);
    experiment->robots = read_robots(root, findings);
    experiment->methods = read_methods(root, "methods: [spherize.cover, approximate.capsules]", checking);
    experiment->elements = required_counts(root, "elements", "elements: [1, 2]", 1, 1e4, findings);
    return experiment;
}

} // namespace foam::bench::experiment
