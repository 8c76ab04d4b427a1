// kind: quality_against_spheres. What spherizers make of whole robots with ever more spheres a link, judged by the
// runtime's own measures on the original geometry.
#include "bench.hpp"
#include "kinds.hpp"

#include <foam/recipe/internal/yaml.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;

/// One method on one robot at one count.
struct Case {
    std::size_t per_link = 0;
    Measures measures;
    double seconds = 0; ///< CPU
};

struct MethodCurve {
    const Chain* method;
    std::vector<Case> cases;
};

struct RobotResult {
    const NamedRobot* robot;
    std::string input; ///< the candidate that was taken
    std::vector<MethodCurve> curves;
};

/// A figure of the measures.
struct Quantity {
    const char* file;
    const char* label;
    double (*value)(const Case& c);
};

constexpr Quantity quantities[] = {
    {"excess.svg", "excess", [](const Case& c) { return c.measures.excess; }},
    {"protrusion.svg", "mean protrusion, mm", [](const Case& c) { return 1e3 * c.measures.protrusion_mean; }},
    {"cpu.svg", "CPU time, s", [](const Case& c) { return c.seconds; }},
};

class QualityAgainstSpheres final : public Experiment {
public:
    std::vector<NamedRobot> robots;
    std::vector<StageCall> filters;
    std::vector<Chain> methods;
    std::vector<std::size_t> spheres; ///< a link, at most
    double time_limit = 60;           ///< s

    std::set<std::string> stages() const override {
        std::set<std::string> names;
        for (const StageCall& filter : filters) {
            names.insert(filter.stage);
        }
        for (const Chain& method : methods) {
            add_names(method, names);
        }
        return names;
    }

    Outcome run(Bench& bench) const override {
        std::vector<RobotResult> results;
        const auto missing =
            for_each_found(*this, bench, robots, [&](const NamedRobot& robot, const std::string& chosen) {
                results.push_back({&robot, chosen, {}});
                for (const Chain& method : methods) {
                    results.back().curves.push_back(measured(bench, robot, method));
                }
            });
        return told(results, missing);
    }

private:
    /// The preparation is done once and counts for every case, as it would if each ran alone.
    MethodCurve measured(const Bench& bench, const NamedRobot& robot, const Chain& method) const {
        Recipe recipe = recipe_of(*this, robot, &method);
        recipe.filters.insert(recipe.filters.begin(), filters.begin(), filters.end());
        RunOptions options;
        options.cancel = bench.cancel();
        Journal journal(nullptr);
        const Cache no_cache{{}};
        const Workspace workspace{recipe, bench.registry(), options, journal, no_cache};
        const double begin = cpu_seconds();
        const Input input = load_input(workspace);
        std::vector<InputFile> mesh_files;
        std::vector<LinkWork> links = prepare_links(workspace, *input.robot, mesh_files);
        const double preparation = cpu_seconds() - begin;

        MethodCurve curve{&method, {}};
        for (const std::size_t count : spheres) {
            LinkOverride all;
            all.glob = "*";
            all.max_spheres = count;
            recipe.links = {std::move(all)};
            for (LinkWork& link : links) {
                link.recipe = recipe.for_link(link.link->name);
            }
            Case c = judged(workspace, links);
            c.per_link = count;
            c.seconds += preparation;
            curve.cases.push_back(c);
            bench.tell(fmt::format("{}: {}, {}, {} a link: {} spheres, excess {}, {} s", name, robot.name, method.label,
                                   count, c.measures.spheres, short_number(c.measures.excess),
                                   short_number(c.seconds)));
            if (c.seconds > time_limit) {
                break;
            }
        }
        return curve;
    }

    /// Spheres of all links, grown to cover, and measured; the measuring is not timed.
    static Case judged(const Workspace& workspace, std::vector<LinkWork> links) {
        const double begin = cpu_seconds();
        std::vector<Group> groups = spherize_links(workspace, links).groups;
        std::vector<Group> lost;
        handle_errors(workspace, links, lost);
        std::vector<std::shared_ptr<const Solid>> solids(groups.size());
        std::vector<SphereTree> trees(groups.size());
        parallel_for(groups.size(), [&](std::size_t g) {
            workspace.check_cancelled();
            solids[g] = solid_of(links[groups[g].link], groups[g].elements);
            trees[g] = finished_tree(*solids[g], std::move(groups[g].tree), Guarantee::outer).tree;
        });
        Case result;
        result.seconds = cpu_seconds() - begin;
        std::vector<Measures> measures(groups.size());
        parallel_for(groups.size(), [&](std::size_t g) {
            workspace.check_cancelled();
            measures[g] = measure(*solids[g], trees[g].finest());
        });
        result.measures = total(measures);
        return result;
    }

    Outcome told(const std::vector<RobotResult>& results, const std::vector<std::string>& missing) const {
        Outcome outcome;
        outcome.cases = case_table(results);
        outcome.sections.push_back({"", method_text(results, missing), "", {}});
        for (const Quantity& quantity : quantities) {
            outcome.figures.push_back({quantity.file, picture(quantity, results)});
            outcome.sections.push_back({quantity.label, "", quantity.file, {}});
            for (const RobotResult& result : results) {
                outcome.sections.push_back({"", "", "", quantity_table(quantity, result)});
            }
        }
        return outcome;
    }

    static Table case_table(const std::vector<RobotResult>& results) {
        Table table{{"robot", "method", "spheres_per_link", "spheres", "excess", "excess_standard_error",
                     "protrusion_max_m", "protrusion_mean_m", "gap_m", "covered", "certified", "cpu_seconds"},
                    {}};
        const auto number = [](double value) { return fmt::format("{:.6g}", value); };
        for (const RobotResult& result : results) {
            for (const MethodCurve& curve : result.curves) {
                for (const Case& c : curve.cases) {
                    const Measures& m = c.measures;
                    table.rows.push_back({result.robot->name, curve.method->label, std::to_string(c.per_link),
                                          std::to_string(m.spheres), number(m.excess), number(m.excess_error),
                                          number(m.protrusion_max), number(m.protrusion_mean), number(m.gap),
                                          number(m.covered), m.certified ? "yes" : "no",
                                          fmt::format("{:.4f}", c.seconds)});
                }
            }
        }
        return table;
    }

    plot::Plot picture(const Quantity& quantity, const std::vector<RobotResult>& results) const {
        plot::Plot plot;
        plot.title = title;
        plot.x = {.label = "spheres a link, at most", .logarithmic = true, .ticks = {spheres.begin(), spheres.end()}};
        plot.y = {.label = quantity.label, .logarithmic = true, .ticks = {}};
        for (const RobotResult& result : results) {
            plot::Panel& panel = plot.panels.emplace_back();
            panel.title = result.robot->name;
            for (const MethodCurve& curve : result.curves) {
                plot::Series& series = panel.series.emplace_back();
                series.label = curve.method->label;
                for (const Case& c : curve.cases) {
                    series.points.emplace_back(c.per_link, quantity.value(c));
                }
            }
        }
        return plot;
    }

    Table quantity_table(const Quantity& quantity, const RobotResult& result) const {
        Table table;
        table.columns = {fmt::format("{}: {}", result.robot->name, quantity.label)};
        for (const std::size_t count : spheres) {
            table.columns.push_back(std::to_string(count));
        }
        for (const MethodCurve& curve : result.curves) {
            std::vector<std::string> row{curve.method->label};
            for (const Case& c : curve.cases) {
                row.push_back(short_number(quantity.value(c)));
            }
            row.resize(table.columns.size(), "left out");
            table.rows.push_back(std::move(row));
        }
        return table;
    }

    std::string method_text(const std::vector<RobotResult>& results, const std::vector<std::string>& missing) const {
        std::string text;
        std::size_t models = 0, certified = 0;
        double gap = 0;
        for (const RobotResult& result : results) {
            text += fmt::format("{} is {}. ", result.robot->name, result.input);
            for (const MethodCurve& curve : result.curves) {
                for (const Case& c : curve.cases) {
                    ++models;
                    certified += c.measures.certified ? 1 : 0;
                    gap = std::max(gap, c.measures.gap);
                }
            }
        }
        if (!missing.empty()) {
            text += fmt::format("Left out, as no candidate is here: {}. ", fmt::join(missing, ", "));
        }
        text += "Every link gets at most the number of spheres that stands on the axis, as the spherizer says to that "
                "number, and spheres are grown to cover the "
                "original geometry. ";
        if (!filters.empty()) {
            std::vector<std::string> names;
            for (const StageCall& filter : filters) {
                names.push_back(text_of(filter));
            }
            text += fmt::format("Before every method: {}. ", fmt::join(names, ", "));
        }
        text += fmt::format(
            "Of the {} models {} are certified, the largest gap is {} m. Excess is the volume of the spheres "
            "outside the robot in units of the robot's; protrusion is the distance of the spheres' exposed "
            "surface from the robot. Times are CPU seconds of the process, user and system, over all its "
            "threads, from the files to covering spheres, without measuring; a case that takes more than "
            "{:g} s is the last of its curve.",
            models, certified, short_number(gap), time_limit);
        return text;
    }
};

} // namespace

std::unique_ptr<Experiment> read_quality_against_spheres(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<QualityAgainstSpheres>();
    Findings& findings = checking.findings;
    const auto values = read_kind_values(root, {Parameter::number("time_limit", 60).bounds(0.001, 1e6).unit("s")},
                                         {"robots", "filters", "methods", "spheres"}, checking);
    take(values, "time_limit", experiment->time_limit);
    experiment->robots = read_robots(root, findings);
    if (const Value* filters = root.find("filters")) {
        if (const auto chain = read_chain(*filters, "filters", {false, true, false, "mesh filters"}, checking)) {
            experiment->filters = chain->filters;
        }
    }
    experiment->methods = read_methods(root, "methods: [spherize.grid]", checking);
    experiment->spheres = required_counts(root, "spheres", "spheres: [1, 2, 4, 8]", 1, 1e5, findings);
    return experiment;
}

} // namespace foam::bench::experiment
