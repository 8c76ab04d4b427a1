#include "finish/finish.hpp"

#include "input/shapes.hpp"

#include <foam/base/parallel.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

bool is_to_be_enclosed(const LinkWork& link) {
    return !link.recipe.skip && !link.error;
}

bool is_loaded(const LinkWork& link) {
    return std::all_of(link.elements.begin(), link.elements.end(),
                       [](const CollisionElement& element) { return element.raw || element.primitive(); });
}

/// Returns what enclosing spheres take of the recipe's budget, with the spheres that links keep.
std::size_t total_of_enclosing(const Recipe& recipe, const std::vector<LinkWork>& links) {
    const Sphere one{{}, 1};
    const std::size_t each = size_of(recipe, {one});
    std::size_t sum = 0;
    for (const LinkWork& link : links) {
        sum += is_to_be_enclosed(link) ? each + link.recipe.keep.size() : 0;
    }
    return sum;
}

} // namespace

bool may_be_enclosed(const Workspace& workspace, const std::vector<LinkWork>& links) {
    const Recipe& recipe = workspace.recipe;
    if (recipe.guarantee == Guarantee::inner || links.empty() || !workspace.limits->may_enclose()) {
        return false;
    }
    const bool loaded = std::all_of(links.begin(), links.end(), [](const LinkWork& link) {
        return !is_to_be_enclosed(link) || is_loaded(link);
    });
    return loaded && total_of_enclosing(recipe, links) <= total_of(recipe).value_or(SIZE_MAX);
}

std::vector<Group> enclosed_groups(const Workspace& workspace, std::vector<LinkWork>& links) {
    std::vector<Group> groups;
    for (std::size_t l = 0; l < links.size(); ++l) {
        if (is_to_be_enclosed(links[l])) {
            groups.emplace_back().link = l;
        }
    }
    parallel_for(groups.size(), [&](std::size_t g) {
        Group& group = groups[g];
        LinkWork& link = links[group.link];
        const ActivityScope activity(place_of("enclose", link.link->name, ""), CrashRemedy::isolate_stage);
        for (std::size_t e = 0; e < link.elements.size(); ++e) {
            group.elements.push_back(e);
        }
        group.solid = quick_solid_of(link);
        group.tree = flat_tree({enclosing_ball(*group.solid)});
        group.uncovered = link.recipe.keep.empty() ? nullptr : group.solid;
        group.in_haste = true;
        link.report.growth = link.report.filled = 0;
    });
    for (const Group& group : groups) {
        workspace.journal.finding({Severity::warning, links[group.link].link->name, "",
                                   fmt::format("the time limit of {} s is too short to prepare its geometry, and to "
                                               "search and measure: one enclosing sphere covers it",
                                               *workspace.time_limit())});
    }
    return groups;
}

} // namespace foam::inline runtime
