// kind: collision_queries. Collision checks and distances of whole robots among random obstacles, original geometry
// against spheres, in several collision libraries: Table I of Coumar et al., "Foam: A Tool for Spherical Approximation
// of Robot Geometry" (2025).
#include "collision_queries.hpp"

#include "bench.hpp"
#include "kinds.hpp"

#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;

struct RobotSource : NamedRobot {
    std::optional<std::size_t> count; ///< of spheres, over the whole robot
    std::string file;                 ///< of spheres
};

class CollisionQueries final : public Experiment {
public:
    std::vector<RobotSource> robots;
    std::vector<std::string> engines;
    std::vector<std::size_t> distances; ///< by engine
    std::optional<Chain> method;
    EnvironmentRule rule;
    std::size_t queries = 100000, environments = 100;
    std::uint64_t seed = 0;
    double time_limit = 3600; ///< CPU s, of an engine on a robot

    std::set<std::string> stages() const override {
        std::set<std::string> names;
        if (method) {
            add_names(*method, names);
        }
        return names;
    }

    Outcome run(Bench& bench) const override {
        QueryResults results{.rule = rule,
                             .counts = counts(),
                             .engines = engines,
                             .distances = distances,
                             .method = method ? method->label : "",
                             .robots = {},
                             .missing = {}};
        results.missing = for_each_found(*this, bench, robots, [&](const RobotSource& robot, const std::string&) {
            results.robots.push_back(measured(bench, robot));
        });
        return told(results);
    }

private:
    QueryCounts counts() const { return {queries, std::min(environments, queries)}; }

    TwoModels models_of(const Bench& bench, const RobotSource& robot) const {
        Recipe recipe = recipe_of(*this, robot, method ? &*method : nullptr);
        recipe.seed = seed;
        recipe.budget_spheres = robot.count;
        RunOptions options;
        options.cancel = bench.cancel();
        Journal journal(nullptr);
        const Cache no_cache{{}};
        const Workspace workspace{recipe, bench.registry(), options, journal, no_cache};
        return robot.count ? with_made_spheres(workspace)
                           : with_given_spheres(workspace, std::filesystem::absolute(file).parent_path() / robot.file);
    }

    RobotQueries measured(Bench& bench, const RobotSource& robot) const {
        RobotQueries result{.name = robot.name, .models = models_of(bench, robot), .reports = {}};
        bench.tell(fmt::format("{}: {}: {} links, {} spheres, {} pairs of links", name, robot.name,
                               result.models.links.size(), shape_count(result.models.spheres),
                               result.models.original.pairs.size()));
        const QueryPlan plan(result.models, rule, counts(), seed);
        for (std::size_t e = 0; e < engines.size(); ++e) {
            const std::string& engine = engines[e];
            result.reports.push_back(asked(bench, result.models, plan, engine, distances[e]));
            const EngineReport& report = result.reports.back();
            const EngineComparison comparison = compare_models(report.answers);
            bench.tell(report.error.empty()
                           ? fmt::format("{}: {}, {}: {} queries, collision {} ms, spheres {} ms", name, robot.name,
                                         engine, comparison.queries(),
                                         short_number(1e3 * comparison.collision.original.value()),
                                         short_number(1e3 * comparison.collision.spheres.value()))
                           : fmt::format("warning: {}: {}, {}: {}", name, robot.name, engine, report.error));
        }
        return result;
    }

    /// In portions, so that poses of many queries need not be in memory at once. The time that is left goes on to the
    /// next portion.
    EngineReport asked(const Bench& bench, const TwoModels& models, const QueryPlan& plan, const std::string& engine,
                       std::size_t distances_asked) const {
        constexpr std::size_t portion = 20000;
        EngineReport all;
        double seconds = time_limit;
        for (std::size_t first = 0; first < queries && all.error.empty(); first += portion) {
            EngineProblem problem;
            problem.engine = engine;
            problem.models = {models.original, models.spheres};
            problem.environments = plan.environments();
            problem.queries = plan.queries(first, std::min(portion, queries - first), distances_asked);
            problem.time_limit = seconds;
            EngineReport report = ask_engine(std::move(problem), [&bench] { return bench.cancelled(); });
            for (const auto& both : report.answers) {
                for (const EngineAnswer& answer : both) {
                    seconds -= answer.seconds();
                }
            }
            seconds = std::max(seconds, 0.0);
            append(all, std::move(report));
        }
        return all;
    }
};

/// {urdf: FILE or [FILE, …], spheres: NUMBER or FILE}
RobotSource read_robot(const Value& value, const std::string& name, Findings& findings) {
    const std::string example = fmt::format("{}: {{urdf: FILE.urdf, spheres: 60}}", name);
    RobotSource robot{{name, {}, findings.locate(value.where)}, {}, {}};
    if (!expect_map(value, name, example, findings)) {
        return robot;
    }
    refuse_unknown_keys(value, name, {"urdf", "spheres"}, findings);
    if (const Value* urdf = value.find("urdf")) {
        robot.candidates = read_references(*urdf, "urdf", findings);
    } else {
        findings.error(value.where, "missing-key",
                       fmt::format("{} needs 'urdf'; remedy: write {}", in_quotes(name), example));
    }
    const Value* spheres = value.find("spheres");
    if (!spheres) {
        findings.error(
            value.where, "missing-key",
            fmt::format("{} needs 'spheres', how many or a file of them; remedy: write {}", in_quotes(name), example));
    } else if (spheres->is(Value::Kind::text)) {
        robot.file = spheres->text;
    } else if (const auto count =
                   read_value(*spheres, Parameter::integer("spheres", 60).bounds(1, 1e5), name, findings)) {
        robot.count = static_cast<std::size_t>(std::get<std::int64_t>(*count));
    }
    return robot;
}

/// A number for all engines, or {ENGINE: NUMBER, …}; those that are not named ask for none.
std::vector<std::size_t> read_distances(const Value* value, const std::vector<std::string>& engines,
                                        Findings& findings) {
    const Parameter declared = Parameter::integer("distances", 100000).bounds(0, 1e8);
    const auto count = [&](const Value& one) {
        const auto read = read_value(one, declared, "", findings);
        return read ? static_cast<std::size_t>(std::get<std::int64_t>(*read)) : 0;
    };
    if (!value || !value->is(Value::Kind::map)) {
        return std::vector<std::size_t>(engines.size(), value ? count(*value) : 100000);
    }
    std::vector<std::size_t> result(engines.size(), 0);
    for (std::size_t i = 0; i < value->keys.size(); ++i) {
        const std::string& name = value->keys[i].text;
        const auto it = std::find(engines.begin(), engines.end(), name);
        if (it == engines.end()) {
            findings.error(value->keys[i].where, "unknown-choice",
                           fmt::format("'distances' names {}, which 'engines' has not{}", in_quotes(name),
                                       suggestion(name, engines)));
        } else {
            result[static_cast<std::size_t>(it - engines.begin())] = count(value->items[i]);
        }
    }
    return result;
}

const std::vector<Parameter>& query_values() {
    static const std::vector<Parameter> values{
        Parameter::integer("queries", 100000).bounds(1, 1e8),
        Parameter::integer("environments", 100).bounds(1, 1e5),
        Parameter::integer("obstacles", 16).bounds(1, 1e4),
        Parameter::number("smallest", 0.05).bounds(1e-4, 10).unit("m"),
        Parameter::number("largest", 0.3).bounds(1e-4, 10).unit("m"),
        Parameter::integer("seed", 0).bounds(0, 1e15),
        Parameter::number("time_limit", 3600).bounds(0.01, 1e7).unit("s"),
    };
    return values;
}

} // namespace

std::vector<std::string> read_engines(const Value* value, Findings& findings) {
    std::vector<std::string> known;
    for (const EngineName& engine : engine_names()) {
        known.emplace_back(engine.name);
    }
    if (!value) {
        return known;
    }
    const std::vector<std::string> engines = read_texts(*value, "engines", findings);
    for (std::size_t i = 0; i < engines.size(); ++i) {
        const Place& where = value->is(Value::Kind::list) ? value->items[i].where : value->where;
        if (std::find(known.begin(), known.end(), engines[i]) == known.end()) {
            findings.error(where, "unknown-choice",
                           fmt::format("'engines' holds {}, got {}{}", fmt::join(known, ", "), in_quotes(engines[i]),
                                       suggestion(engines[i], known)));
        } else if (std::find(engines.begin(), engines.begin() + static_cast<std::ptrdiff_t>(i), engines[i]) !=
                   engines.begin() + static_cast<std::ptrdiff_t>(i)) {
            findings.error(where, "twice", fmt::format("'engines' holds {} twice", in_quotes(engines[i])));
        }
    }
    return engines;
}

std::unique_ptr<Experiment> read_collision_queries(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<CollisionQueries>();
    Findings& findings = checking.findings;
    const auto values = read_kind_values(root, query_values(), {"robots", "method", "engines", "distances"}, checking);
    take(values, "queries", experiment->queries);
    take(values, "environments", experiment->environments);
    take(values, "obstacles", experiment->rule.obstacles);
    take(values, "seed", experiment->seed);
    take(values, "smallest", experiment->rule.smallest);
    take(values, "largest", experiment->rule.largest);
    take(values, "time_limit", experiment->time_limit);
    if (experiment->rule.smallest > experiment->rule.largest) {
        findings.error({0, 1, 1}, "out-of-order",
                       fmt::format("'smallest' is {:g} m and 'largest' {:g} m; remedy: the other way round",
                                   experiment->rule.smallest, experiment->rule.largest));
    }
    experiment->engines = read_engines(root.find("engines"), findings);
    experiment->distances = read_distances(root.find("distances"), experiment->engines, findings);
    for (std::size_t& count : experiment->distances) {
        count = std::min(count, experiment->queries);
    }
    if (const Value* method = root.find("method")) {
        experiment->method = read_method(*method, checking);
    }
    if (const Value* robots = required(root, "robots", "robots: {panda: {urdf: FILE.urdf, spheres: 60}}", findings);
        robots && expect_map(*robots, "robots", "robots: {panda: {urdf: FILE.urdf, spheres: 60}}", findings)) {
        for (std::size_t i = 0; i < robots->keys.size(); ++i) {
            experiment->robots.push_back(read_robot(robots->items[i], robots->keys[i].text, findings));
            if (experiment->robots.back().count && !root.find("method")) {
                findings.error(robots->items[i].where, "missing-key",
                               fmt::format("{} is to get {} spheres, but 'method' is missing; remedy: write method: "
                                           "spherize.medial",
                                           in_quotes(robots->keys[i].text), *experiment->robots.back().count));
            }
        }
        if (robots->keys.empty()) {
            findings.error(robots->where, "wrong-type", "'robots' expects at least one robot");
        }
    }
    return experiment;
}

} // namespace foam::bench::experiment
