// Asks collision libraries what foam.bench wants to know: a request as JSON on standard input, answers as lines of
// JSON. The figures of queries go into files of doubles, a row for each query and model: state (0 not asked, 1
// answered, 2 aborted), hits an obstacle, hits itself, CPU s to move, to check, to measure distances, and the distance
// in m. Keys: python/foam/bench/engines.py.
#include "bench/src/queries/elements.hpp"
#include "bench/src/queries/plan.hpp"
#include "bench/src/queries/robots.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/registry.hpp>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <csignal>
#include <iostream>
#include <iterator>
#include <sys/prctl.h>

namespace foam {
namespace {

using nlohmann::json;

void answer(const json& line) {
    std::cout << line.dump(-1, ' ', true, json::error_handler_t::replace) << std::endl; // at once, for those who wait
}

std::string bytes_of(const EngineReport& report) {
    std::vector<double> rows;
    for (const auto& both : report.answers) {
        for (const EngineAnswer& one : both) {
            rows.insert(rows.end(),
                        {static_cast<double>(one.state), one.hits_obstacle ? 1.0 : 0.0, one.hits_itself ? 1.0 : 0.0,
                         one.move_seconds, one.collision_seconds, one.distance_seconds, one.distance});
        }
    }
    return {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(double)};
}

void answer(const std::string& engine, const char* what, const EngineReport& report, const json& request) {
    const std::filesystem::path file =
        std::filesystem::path(request.at("folder").get<std::string>()) / fmt::format("{}_{}", engine, what);
    write_file(file, bytes_of(report));
    answer(json{{"engine", engine},
                {"what", what},
                {"version", report.version},
                {"why_not", report.error},
                {"aborts", report.aborts},
                {"file", file.string()}});
}

std::size_t shape_count(const EngineRobot& robot) {
    std::size_t count = 0;
    for (const EngineBody& body : robot.bodies) {
        count += body.size();
    }
    return count;
}

/// Asks in portions, so that poses of many queries need not be in memory at once. The time that is left goes on to the
/// next portion.
EngineReport asked(const TwoModels& models, const QueryPlan& plan, const std::string& engine, std::size_t distances,
                   const json& request) {
    constexpr std::size_t portion = 20000;
    const std::size_t queries = request.at("queries");
    EngineReport all;
    double seconds = request.at("time_limit");
    for (std::size_t first = 0; first < queries && all.error.empty(); first += portion) {
        EngineProblem problem;
        problem.engine = engine;
        problem.models = {models.original, models.spheres};
        problem.environments = plan.environments();
        problem.queries = plan.queries(first, std::min(portion, queries - first), distances);
        problem.time_limit = seconds;
        EngineReport report = ask_engine(std::move(problem));
        for (const auto& both : report.answers) {
            for (const EngineAnswer& one : both) {
                seconds -= one.seconds();
            }
        }
        seconds = std::max(seconds, 0.0);
        append(all, std::move(report));
    }
    return all;
}

/// The robot and its spheres among obstacles.
void ask_robots(const Original& original, const std::vector<LinkSpheres>& spheres, const json& request) {
    const std::uint64_t seed = request.at("seed");
    const TwoModels models = two_models(original, spheres, seed);
    answer(json{{"links", models.links.size()},
                {"shapes", shape_count(models.original)},
                {"spheres", shape_count(models.spheres)},
                {"pairs", models.original.pairs.size()},
                {"ignored_pairs", models.ignored_pairs}});
    const QueryPlan plan(models, {request.at("obstacles"), request.at("smallest"), request.at("largest")},
                         {request.at("queries"), request.at("environments")}, seed);
    for (const auto& [engine, distances] : request.at("distances").items()) {
        answer(engine, "queries", asked(models, plan, engine, distances.get<std::size_t>(), request), request);
    }
}

EngineQuery self_check(std::vector<Pose> poses, const json& request) {
    EngineQuery query;
    query.poses = std::move(poses);
    query.self_checks = request.at("repeats");
    return query;
}

EngineReport checked(const std::string& engine, const EngineRobot& robot, const std::vector<EngineQuery>& queries,
                     const json& request) {
    EngineProblem problem;
    problem.engine = engine;
    problem.models = {robot, robot}; // each is measured: twice as many samples
    problem.environments = {{}};
    problem.queries = queries;
    problem.time_limit = request.at("time_limit");
    return ask_engine(std::move(problem));
}

/// The poses of the bodies in a random configuration: the same for all models of a robot with the same links.
std::vector<Pose> configuration(const Kinematics& kinematics, const ElementRobot& whole, std::uint64_t seed,
                                std::size_t index) {
    Random random(derive_seed(seed, fmt::format("configuration {}", index)));
    const std::vector<Pose> all = kinematics.link_poses(kinematics.random_configuration(random));
    std::vector<Pose> result;
    for (const std::size_t link : whole.links) {
        result.push_back(all[link]);
    }
    return result;
}

/// Near pairs of a model's elements, and the robot against itself.
void ask_elements(const Original& original, const std::vector<LinkSpheres>& links, const json& request) {
    const Kinematics kinematics(original.robot);
    const ElementRobot whole = element_robot(kinematics, links);
    std::size_t elements = 0;
    double price = 0;
    for (const LinkSpheres& link : links) {
        elements += link.elements.size();
        price += price_of(link.elements, ElementCost());
    }
    answer(json{{"elements", elements},
                {"price", price / static_cast<double>(elements)},
                {"shape_pairs", shape_pairs(whole.robot)}});
    const std::uint64_t seed = request.at("seed");
    Random random(derive_seed(seed, "near pairs"));
    const NearPairs near(links, request.at("pairs"), random);
    std::vector<EngineQuery> near_queries, whole_queries;
    for (std::size_t i = 0; i < request.at("poses"); ++i) {
        near_queries.push_back(self_check(near.poses(random), request));
        whole_queries.push_back(self_check(configuration(kinematics, whole, seed, i), request));
    }
    for (const std::string& engine : request.at("engines").get<std::vector<std::string>>()) {
        answer(engine, "near", checked(engine, near.robot(), near_queries, request), request);
        answer(engine, "whole", checked(engine, whole.robot, whole_queries, request), request);
    }
}

void serve(const json& request) {
    Registry registry;
    for (const std::filesystem::path& folder : plugin_directories()) {
        registry.load_directory(folder);
    }
    const Original original = load_original(request.at("urdf").get<std::string>(), registry);
    const std::vector<LinkSpheres> model = matched_elements(original, request.at("model").get<std::string>(), registry);
    request.at("task") == "robots" ? ask_robots(original, model, request) : ask_elements(original, model, request);
}

} // namespace
} // namespace foam

int main() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    try {
        const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
        foam::serve(nlohmann::json::parse(text));
        return 0;
    } catch (const foam::Error& error) {
        foam::answer(nlohmann::json{{"error", error.what()}, {"code", foam::to_string(error.code())}});
    } catch (const std::exception& error) {
        foam::answer(nlohmann::json{{"error", error.what()}, {"code", "internal"}});
    }
    return 1;
}
