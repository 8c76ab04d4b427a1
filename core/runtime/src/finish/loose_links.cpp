#include "finish/loose_links.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

constexpr double loose_excess = 3; ///< the spheres have four times the volume of the geometry
constexpr double looser = 3;       ///< times the excess of the robot
constexpr std::size_t more = 3;    ///< times as many spheres has the link with the most

} // namespace

void tell_loose_links(const Workspace& workspace, const FinishedModel& finished) {
    const Recipe& recipe = workspace.recipe;
    if (!recipe.budget_spheres || recipe.budget_share || recipe.guarantee != Guarantee::outer) {
        return; // no allocation by volume
    }
    std::size_t most = 0;
    std::vector<Measures> all;
    bool spheres = true;
    for (const FinishedLink& link : finished.links) {
        most = std::max(most, link.elements.size());
        spheres = spheres && link.elements.are_spheres();
        all.push_back(link.work->report.measures);
    }
    const double excess = total(all).excess;
    std::vector<std::string> names;
    double largest = 0;
    for (const FinishedLink& link : finished.links) {
        const double own = link.work->report.measures.excess;
        if (own > loose_excess && own > looser * excess && most >= more * link.elements.size()) {
            names.push_back(shown(link.work->link->name));
            largest = std::max(largest, own);
        }
    }
    if (!names.empty()) {
        constexpr std::size_t most_named = 3;
        const bool one = names.size() == 1;
        const std::size_t others = names.size() - std::min(names.size(), most_named);
        names.resize(std::min(names.size(), most_named));
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format(
                 "few {} fit {} loosely: {}{}: excess {}{:.1f}, the robot's is {:.2f}; the allocation goes "
                 "by volume, and small links have little; remedy: budget: {{share: even}}, or links: {{{}: "
                 "{{min_spheres: …}}}}",
                 spheres ? "spheres" : "elements", one ? "a small link" : "small links", fmt::join(names, ", "),
                 others > 0 ? fmt::format(" and {} more", others) : "", one ? "" : "up to ", largest, excess,
                 names.front())});
    }
}

} // namespace foam::inline runtime
