// Tables of collision_queries.
#include "collision_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline bench::experiment {
namespace {

constexpr const char* not_measured = "not measured";

std::string in_milliseconds(const Mean& mean) {
    return short_number(1e3 * mean.value());
}

/// "-0.0123 ± 0.0004": the sign says which way.
std::string signed_milliseconds(const Mean& mean) {
    if (mean.count() == 0) {
        return not_measured;
    }
    const double value = 1e3 * mean.value();
    return fmt::format("{}{} ± {}", value > 0 ? "+" : "", short_number(value), short_number(1e3 * mean.error()));
}

std::string in_percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? "–" : fmt::format("{:.3f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string signed_percent(const Mean& share) {
    return share.count() == 0 ? not_measured
                              : fmt::format("{:+.3f} ± {}", 100 * share.value(), short_number(100 * share.error()));
}

/// As the paper's Table I: for each library the spheres' figures minus the original's.
Table difference_table(const QueryResults& results) {
    Table table{{"robot"}, {}};
    for (const std::string& engine : results.engines) {
        const char* label = find_engine(engine).label;
        for (const char* quantity : {"Δ collision, ms", "Δ distance, ms", "Δ validity, %"}) {
            table.columns.push_back(fmt::format("{}: {}", label, quantity));
        }
    }
    for (const RobotQueries& robot : results.robots) {
        std::vector<std::string> row{robot.name};
        for (const EngineReport& report : robot.reports) {
            const EngineComparison comparison = compare_models(report.answers);
            row.push_back(signed_milliseconds(comparison.collision.difference));
            row.push_back(signed_milliseconds(comparison.distance.difference));
            row.push_back(signed_percent(comparison.collides.difference));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Original and spheres of one library side by side.
Table engine_table(const QueryResults& results, std::size_t engine) {
    Table table{{"robot", "shapes", "spheres", "queries", "collision, ms", "by spheres, ms", "distances",
                 "distance, ms", "by spheres, ms", "aborted", "aborted by spheres"},
                {}};
    for (const RobotQueries& robot : results.robots) {
        const EngineReport& report = robot.reports[engine];
        const EngineComparison c = compare_models(report.answers);
        const std::size_t n = c.queries();
        std::vector<std::string> row{robot.name, std::to_string(shape_count(robot.models.original)),
                                     std::to_string(shape_count(robot.models.spheres)), std::to_string(n)};
        if (n == 0) {
            row.emplace_back(not_measured);
            row.resize(table.columns.size());
        } else {
            const std::vector<std::string> figures{in_milliseconds(c.collision.original),
                                                   in_milliseconds(c.collision.spheres),
                                                   std::to_string(c.distance.original.count()),
                                                   in_milliseconds(c.distance.original),
                                                   in_milliseconds(c.distance.spheres),
                                                   std::to_string(c.aborted[0]),
                                                   std::to_string(c.aborted[1])};
            row.insert(row.end(), figures.begin(), figures.end());
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Whether the verdicts differ by obstacles or by what the robot does to itself.
Table validity_table(const QueryResults& results) {
    Table table{{"robot", "library", "collides, %", "spheres collide, %", "Δ, %", "Δ by obstacles, %", "Δ by itself, %",
                 "only spheres", "only the original"},
                {}};
    for (const RobotQueries& robot : results.robots) {
        for (std::size_t e = 0; e < results.engines.size(); ++e) {
            const EngineComparison c = compare_models(robot.reports[e].answers);
            if (const std::size_t n = c.queries(); n > 0) {
                table.rows.push_back({robot.name, find_engine(results.engines[e]).label,
                                      in_percent(c.collides.holds[0], n), in_percent(c.collides.holds[1], n),
                                      signed_percent(c.collides.difference), signed_percent(c.hits_obstacle.difference),
                                      signed_percent(c.hits_itself.difference), std::to_string(c.collides.only_spheres),
                                      std::to_string(c.collides.only_original)});
            }
        }
    }
    return table;
}

/// The engine that knows the original as it is: FCL, of one kind or the other. None: nothing to hold against.
const EngineReport* exact_report(const RobotQueries& robot, const std::vector<std::string>& engines) {
    for (std::size_t e = 0; e < engines.size(); ++e) {
        if (engines[e].starts_with("fcl") && compare_models(robot.reports[e].answers).queries() > 0) {
            return &robot.reports[e];
        }
    }
    return nullptr;
}

Table missed_table(const QueryResults& results) {
    Table table{{"robot", "library", "original hits an obstacle", "missed by spheres", "original hits itself",
                 "missed by spheres"},
                {}};
    for (const RobotQueries& robot : results.robots) {
        const EngineReport* exact = exact_report(robot, results.engines);
        for (std::size_t e = 0; exact && e < results.engines.size(); ++e) {
            if (compare_models(robot.reports[e].answers).queries() > 0) {
                const Missed missed = missed_by(robot.reports[e].answers, exact->answers);
                table.rows.push_back({robot.name, find_engine(results.engines[e]).label,
                                      std::to_string(missed.obstacle_hits), std::to_string(missed.obstacles),
                                      std::to_string(missed.self_hits), std::to_string(missed.selves)});
            }
        }
    }
    return table;
}

std::string missed_text(const QueryResults& results) {
    Missed sum;
    std::size_t certified = 0;
    for (const RobotQueries& robot : results.robots) {
        certified += robot.models.certified ? 1 : 0;
        const EngineReport* exact = exact_report(robot, results.engines);
        for (const EngineReport& report : robot.reports) {
            const Missed missed =
                exact && robot.models.certified ? missed_by(report.answers, exact->answers) : Missed{};
            sum.obstacle_hits += missed.obstacle_hits;
            sum.obstacles += missed.obstacles;
            sum.self_hits += missed.self_hits;
            sum.selves += missed.selves;
        }
    }
    return fmt::format(
        "Spheres that are certified hold the whole surface of the original. Where that touches an obstacle, or "
        "another link, a sphere does too: they miss no collision of the original's surface as FCL finds it on the "
        "meshes "
        "themselves. Of {} models {} are certified; of {} such hits of obstacles, over all libraries, their spheres "
        "missed {}, of {} hits of other links {}. A library that takes hulls for meshes finds collisions where the "
        "original has none; spheres may miss those ('only the original', above).",
        results.robots.size(), certified, sum.obstacle_hits, sum.obstacles, sum.self_hits, sum.selves);
}

/// "2000 in FCL, 20000 in Bullet"
std::string distances_text(const QueryResults& results) {
    std::vector<std::string> each;
    for (std::size_t e = 0; e < results.engines.size(); ++e) {
        each.push_back(fmt::format("{} in {}", results.distances[e], find_engine(results.engines[e]).label));
    }
    return fmt::format("{}", fmt::join(each, "; "));
}

std::string method_text(const QueryResults& results) {
    std::string text;
    for (const RobotQueries& robot : results.robots) {
        const TwoModels& models = robot.models;
        text += fmt::format("{} is {}: {} links, {} spheres, excess {}, {}; {} pairs of links are tested, {} ignored. ",
                            robot.name, models.input, models.links.size(), shape_count(models.spheres),
                            short_number(models.excess), models.certified ? "certified" : "not certified",
                            models.original.pairs.size(), models.ignored_pairs);
    }
    if (!results.missing.empty()) {
        text += fmt::format("Left out, as no candidate is here: {}. ", fmt::join(results.missing, ", "));
    }
    if (!results.method.empty()) {
        text += fmt::format("Spheres by {}. ", results.method);
    }
    text += fmt::format(
        "{} configurations, uniform within the limits of the joints, in {} environments of {} obstacles: boxes and "
        "spheres in turn, edges and diameters from {:g} to {:g} m, anywhere in the box that the robot reaches, clear "
        "of "
        "the links that do not move. The same for both models and all libraries. Pairs of links "
        "that a self-collision matrix of the spheres leaves out (neighbours, and what "
        "touches in the zero configuration, or in all or none of 10000 random ones), and those that touch in most, "
        "are not tested against each other, in either model.\n\n"
        "A time is the CPU time of the one thread that asks, in milliseconds, and has in it to bring the geometry to "
        "the "
        "poses of the links. A collision check stops at the first collision where the library can, obstacles before "
        "the "
        "robot itself. Some of the queries, evenly among all, ask for the distance too, to obstacles and of the robot "
        "to itself: {}. The two models "
        "are asked in turn, in one process. Δ: spheres minus original, so that a negative time says that spheres are "
        "faster and a positive validity that more configurations collide with spheres; ± its standard error.",
        results.counts.queries, results.counts.environments, results.rule.obstacles, results.rule.smallest,
        results.rule.largest, distances_text(results));
    return text;
}

std::string engine_text(const QueryResults& results, std::size_t engine) {
    const std::string& name = results.engines[engine];
    std::string text;
    if (name == "fcl") {
        text =
            "Dynamic AABB trees over shapes and obstacles. Meshes are surfaces; distances are unsigned, since signed "
            "ones abort.";
    } else if (name == "fcl_pairs") {
        text = "Every shape against every other, without trees, as Pinocchio does. Otherwise as FCL.";
    } else if (name == "bullet") {
        text = "A link is a compound shape, a mesh its convex hull, as in PyBullet, without margins. Signed distances.";
    } else {
        text = "Meshes are convex hulls, flat ones 0.2 mm thick. There is no query for distances: all contacts within "
               "a margin larger than the "
               "scene are asked for; those of hulls and cylinders are not exact.";
    }
    std::vector<std::string> remarks;
    for (const RobotQueries& robot : results.robots) {
        const EngineReport& report = robot.reports[engine];
        const EngineComparison comparison = compare_models(report.answers);
        if (!report.error.empty()) {
            remarks.push_back(fmt::format("{}: {}", robot.name, report.error));
        } else if (comparison.not_asked > 0) {
            remarks.push_back(
                fmt::format("{}: {} queries were not asked, the time was up", robot.name, comparison.not_asked));
        }
        if (!report.aborts.empty()) {
            remarks.push_back(fmt::format("{}: {} queries ended the process ({})", robot.name, report.aborts.size(),
                                          report.aborts.front()));
        }
    }
    return remarks.empty() ? text : fmt::format("{} {}.", text, fmt::join(remarks, "; "));
}

std::string engine_title(const QueryResults& results, std::size_t engine) {
    const EngineName& name = find_engine(results.engines[engine]);
    for (const RobotQueries& robot : results.robots) {
        if (!robot.reports[engine].version.empty()) {
            return fmt::format("{} ({})", name.label, robot.reports[engine].version);
        }
    }
    return name.label;
}

Table case_table(const QueryResults& results) {
    Table table{{"robot",
                 "engine",
                 "version",
                 "model",
                 "shapes",
                 "queries",
                 "aborted",
                 "move_ms",
                 "collision_ms",
                 "collision_ms_error",
                 "collision_ms_difference",
                 "collision_ms_difference_error",
                 "distances",
                 "distance_ms",
                 "distance_ms_error",
                 "distance_ms_difference",
                 "distance_ms_difference_error",
                 "mean_distance_m",
                 "collides",
                 "collides_alone",
                 "hits_obstacle",
                 "hits_itself",
                 "remark"},
                {}};
    const auto ms = [](double seconds) { return std::isfinite(seconds) ? fmt::format("{:.6g}", 1e3 * seconds) : ""; };
    for (const RobotQueries& robot : results.robots) {
        for (std::size_t e = 0; e < results.engines.size(); ++e) {
            const EngineReport& report = robot.reports[e];
            const EngineComparison c = compare_models(report.answers);
            for (const bool spheres : {false, true}) {
                const auto mean = [&](const Paired& paired) -> const Mean& {
                    return spheres ? paired.spheres : paired.original;
                };
                table.rows.push_back(
                    {robot.name,
                     results.engines[e],
                     report.version,
                     spheres ? "spheres" : "original",
                     std::to_string(shape_count(spheres ? robot.models.spheres : robot.models.original)),
                     std::to_string(c.queries()),
                     std::to_string(c.aborted[spheres ? 1 : 0]),
                     ms(mean(c.move).value()),
                     ms(mean(c.collision).value()),
                     ms(mean(c.collision).error()),
                     ms(c.collision.difference.value()),
                     ms(c.collision.difference.error()),
                     std::to_string(c.distance.original.count()),
                     ms(mean(c.distance).value()),
                     ms(mean(c.distance).error()),
                     ms(c.distance.difference.value()),
                     ms(c.distance.difference.error()),
                     std::isfinite(mean(c.metres).value()) ? fmt::format("{:.6g}", mean(c.metres).value()) : "",
                     std::to_string(c.collides.holds[spheres ? 1 : 0]),
                     std::to_string(spheres ? c.collides.only_spheres : c.collides.only_original),
                     std::to_string(c.hits_obstacle.holds[spheres ? 1 : 0]),
                     std::to_string(c.hits_itself.holds[spheres ? 1 : 0]),
                     report.error});
            }
        }
    }
    return table;
}

} // namespace

std::size_t shape_count(const EngineRobot& robot) {
    std::size_t count = 0;
    for (const EngineBody& body : robot.bodies) {
        count += body.size();
    }
    return count;
}

Outcome told(const QueryResults& results) {
    Outcome outcome;
    outcome.cases = case_table(results);
    outcome.sections.push_back({"", method_text(results), "", {}});
    outcome.sections.push_back({"Spheres minus original", "", "", difference_table(results)});
    if (Table validity = validity_table(results); !validity.rows.empty()) {
        outcome.sections.push_back(
            {"Where verdicts differ",
             "Every query is asked for obstacles and for the robot itself. A configuration that collides with both "
             "counts in both columns, so that these may add up to more than the whole. 'only spheres': queries in "
             "which the spheres collide and the original does not.",
             "", std::move(validity)});
    }
    for (std::size_t e = 0; e < results.engines.size(); ++e) {
        outcome.sections.push_back({engine_title(results, e), engine_text(results, e), "", engine_table(results, e)});
    }
    const Table missed = missed_table(results);
    if (!missed.rows.empty()) {
        outcome.sections.push_back({"Collisions that spheres miss", missed_text(results), "", missed});
    }
    return outcome;
}

} // namespace foam::bench::experiment
