#include "session_work.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/ladder.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/recipe/internal/glob.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/run.hpp>
#include <foam/search/spherize.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace foam::inline view {
namespace {

CoverOptions within(double seconds, const std::atomic<bool>& cancel) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    CoverOptions options;
    options.effort = Effort::fast;
    options.stop = [end, &cancel] { return cancel || std::chrono::steady_clock::now() >= end; };
    return options;
}

std::vector<Sphere> finished(const Solid& solid, std::vector<Sphere> spheres) {
    return finished_tree(solid, flat_tree(std::move(spheres)), Guarantee::outer, false, Numbers::float32).tree.finest();
}

} // namespace

std::vector<Sphere> pinned_in(const LinkState& link) {
    std::vector<Sphere> pinned;
    for (std::size_t i = 0; i < link.spheres.size(); ++i) {
        if (link.pinned[i]) {
            pinned.push_back(link.spheres[i]);
        }
    }
    return pinned;
}

/// Returns the kept spheres and others that cover `rest`.
static std::vector<Sphere> with_others(const Solid& solid, const Solid& rest, std::size_t others,
                                       const std::vector<Sphere>& kept, const CoverOptions& options) {
    std::vector<Sphere> all = kept;
    const SphereTree beside = beside_kept(solid, flat_tree(finished(rest, spherize(rest, others, options).spheres)));
    all.insert(all.end(), beside.finest().begin(), beside.finest().end());
    return all;
}

std::vector<Sphere> searched_link(const Solid& solid, std::size_t count, const std::vector<Sphere>& kept,
                                  double seconds, const std::atomic<bool>& cancel) {
    const CoverOptions options = within(seconds, cancel);
    if (kept.empty()) {
        return finished(solid, spherize(solid, count, options).spheres);
    }
    const Certificate certificate = certify(solid, kept);
    if (certificate.holds) {
        return kept;
    }
    if (kept.size() >= count) {
        throw Error(ErrorCode::usage,
                    fmt::format("the {} pinned sphere{} leave{} geometry uncovered; remedy: more "
                                "spheres, or pin fewer",
                                kept.size(), kept.size() == 1 ? "" : "s", kept.size() == 1 ? "s" : ""));
    }
    Mesh left = certificate.cavity ? Mesh{} : geometry::left_uncovered(solid.surface(), kept);
    const std::size_t others = count - kept.size();
    if (!left.triangles.empty()) {
        std::vector<Sphere> all = with_others(solid, *Solid::make(std::move(left)), others, kept, options);
        if (covers(solid, all)) {
            return all;
        }
    }
    return with_others(solid, solid, others, kept, options); // what leaves a cavity covers all anew
}

std::vector<Sphere> closed_link(const Solid& solid, const std::vector<Sphere>& spheres) {
    return finished(solid, spheres);
}

/// Adds what the options say of links. `allocated`: weights have an effect.
static void add_choices(Recipe& recipe, const ViewedRobot& robot, const RobotChoices& choices, bool allocated) {
    for (const Link& link : robot.robot->links) {
        if (!is_chosen(choices, link.name)) {
            LinkOverride change;
            change.glob = glob_of_name(link.name);
            change.skip = true;
            recipe.links.push_back(std::move(change));
        }
    }
    for (const auto& [glob, weight] : choices.weights) {
        LinkOverride change;
        change.glob = glob;
        change.weight = weight;
        if (allocated) {
            recipe.links.push_back(std::move(change));
        }
    }
}

Recipe recipe_of(const ViewedRobot& robot, const SubjectOptions& options, Registry& registry, const ModelState& state,
                 std::optional<std::size_t> count, bool everything) {
    const QuickBudget budget{.spheres = count, .excess = {}, .max_protrusion = {}};
    const bool mesh = is_mesh_file(robot.file, registry);
    const std::string geometry = words_of_covered_geometry()[static_cast<std::size_t>(options.geometry)];
    const QuickRecipe quick = quick_recipe(robot.file, std::string("cover"), mesh ? "json" : "urdf", budget,
                                           mesh ? options.unit : MeshUnit{}, geometry, registry);
    RecipeResult read =
        parse_recipe(quick.text, quick.name + ".yaml", registry, {{"stages.spherize.cover.effort", "fast"}});
    if (!read.ok()) {
        throw Error(ErrorCode::internal, read.diagnostics.front().text());
    }
    Recipe recipe = std::move(read.recipes.front());
    add_choices(recipe, robot, options.choices, count.has_value());
    for (std::size_t l = 0; l < state.size(); ++l) {
        const std::vector<Sphere> kept = everything ? state[l]->spheres : pinned_in(*state[l]);
        const bool without = everything && kept.empty() && robot.links[l].judged;
        const double weight = everything ? 1 : state[l]->weight; // without a budget nothing is allocated
        if ((kept.empty() && weight == 1 && !without) || !is_chosen(options.choices, robot.robot->links[l].name)) {
            continue;
        }
        LinkOverride change;
        change.glob = glob_of_name(robot.robot->links[l].name);
        if (!kept.empty()) {
            change.keep = kept;
        }
        if (without) {
            change.skip = true;
        }
        if (weight != 1) {
            change.weight = weight;
        }
        recipe.links.push_back(std::move(change));
    }
    return recipe;
}

std::vector<std::vector<Sphere>> spheres_of(const ViewedRobot& robot, const SubjectOptions& options, Registry& registry,
                                            std::size_t count, const ModelState& state,
                                            const std::atomic<bool>* cancel) {
    const Recipe recipe = recipe_of(robot, options, registry, state, count, false);
    RunOptions run_options;
    run_options.cancel = cancel;
    run_options.report = false;
    run_options.input = robot.loaded;
    const RunResult result = run(recipe, registry, run_options);
    std::vector<std::vector<Sphere>> spheres(robot.robot->links.size());
    for (const SphereGroup& group : result.model.groups) {
        std::vector<Sphere>& of_link = spheres[link_index(*robot.robot, group.link)];
        of_link.insert(of_link.end(), group.tree.finest().begin(), group.tree.finest().end());
    }
    return spheres;
}

std::vector<std::size_t> candidate_counts(const ViewedRobot& robot) {
    std::vector<std::size_t> counts;
    const auto links = static_cast<std::size_t>(
        std::count_if(robot.links.begin(), robot.links.end(), [](const ViewedLink& link) { return link.judged; }));
    if (links == 0) {
        return counts;
    }
    for (std::size_t count = links; counts.size() < 16 && count <= 24 * links; count = rung_above(count)) {
        counts.push_back(count);
    }
    return counts;
}

} // namespace foam::inline view
