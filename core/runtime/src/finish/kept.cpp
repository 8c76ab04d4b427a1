#include "finish/finish.hpp"

#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/links.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

/// Sets the part of the group's geometry that the kept spheres leave uncovered.
void find_uncovered(const Workspace& workspace, LinkWork& link, Group& group) {
    const Recipe::LinkRecipe& recipe = link.recipe;
    group.solid = solid_of(link, group.elements);
    if (const Certificate certificate = certify(*group.solid, recipe.keep); certificate.cavity) {
        group.uncovered = group.solid;
    } else if (!certificate.holds) {
        Mesh left = geometry::left_uncovered(group.solid->surface(), recipe.keep);
        if (!left.triangles.empty()) {
            group.uncovered = Solid::make(std::move(left));
        }
    }
    const std::size_t kept = recipe.keep.size();
    if (group.uncovered && recipe.max_spheres && *recipe.max_spheres <= kept) {
        throw Error(ErrorCode::recipe, fmt::format("the link keeps {} sphere{}, which leave geometry uncovered, and is "
                                                   "to have at most {}; remedy: allow more than it keeps",
                                                   kept, kept == 1 ? "" : "s", *recipe.max_spheres));
    }
    if (!group.uncovered && recipe.min_spheres > kept) {
        workspace.journal.finding({Severity::warning, link.link->name, "",
                                   fmt::format("the {} sphere{} that it keeps cover it: it gets no others, and not the "
                                               "minimum of {}",
                                               kept, kept == 1 ? "" : "s", recipe.min_spheres)});
    }
}

} // namespace

std::vector<Group> take_covered_groups(const Workspace& workspace, std::vector<LinkWork>& links,
                                       std::vector<Group>& groups) {
    parallel_for(groups.size(), [&](std::size_t g) {
        LinkWork& link = links[groups[g].link];
        if (link.recipe.keep.empty()) {
            return;
        }
        const std::string& input = link.elements[groups[g].elements.front()].geometry;
        const ActivityScope activity(place_of("geometry", link.link->name, input), CrashRemedy::isolate_stage);
        try {
            find_uncovered(workspace, link, groups[g]);
        } catch (...) {
            const Error error = described(std::current_exception(), "geometry", link.link->name, input);
            if (error.code() == ErrorCode::cancelled) {
                throw error;
            }
            link.error.emplace(error);
        }
    });
    std::erase_if(groups, [&](const Group& group) { return links[group.link].error.has_value(); });
    std::vector<Group> covered;
    const auto is_covered = [&](const Group& group) {
        return !links[group.link].recipe.keep.empty() && !group.uncovered;
    };
    std::copy_if(groups.begin(), groups.end(), std::back_inserter(covered), is_covered);
    std::erase_if(groups, is_covered);
    for (Group& group : covered) {
        group.tree.levels.resize(1);
    }
    return covered;
}

std::size_t kept_spheres(const std::vector<LinkWork>& links, const std::vector<Group>& groups) {
    std::size_t kept = 0;
    for (const Group& group : groups) {
        kept += links[group.link].recipe.keep.size();
    }
    return kept;
}

SphereTree with_kept(const std::vector<Sphere>& kept, SphereTree tree) {
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        SphereTree::Level& level = tree.levels[l];
        level.elements.spheres().insert(level.elements.spheres().begin(), kept.begin(), kept.end());
        if (l == 0) {
            continue;
        }
        std::vector<std::uint32_t> parents(kept.size()); // each is its own parent; indices count spheres first
        for (std::size_t i = 0; i < kept.size(); ++i) {
            parents[i] = static_cast<std::uint32_t>(i);
        }
        for (const std::uint32_t parent : level.parents) {
            parents.push_back(parent + static_cast<std::uint32_t>(kept.size()));
        }
        level.parents = std::move(parents);
    }
    return tree;
}

} // namespace foam::inline runtime
