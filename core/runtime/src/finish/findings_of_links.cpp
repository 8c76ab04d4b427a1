// What is reported of finished links: those that are hollow, that hang loose, or that their visual geometry leaves.
#include "finish/finish.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/measure.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

constexpr double little = 0.25; ///< of the box
constexpr double thin = 0.04;   ///< of the diagonal of the box

} // namespace

void tell_hollow_links(const Workspace& workspace, const FinishedModel& finished) {
    for (const FinishedLink& link : finished.links) {
        const Measures& m = link.work->report.measures;
        const Vec3 size = link.solid->bounds().size();
        const double box = size.x * size.y * size.z;
        if (link.work->recipe.hollow == Hollow::fill || link.work->bounds_only || !(box > 0) || !(m.area > 0)) {
            continue;
        }
        // A plate of thickness t has the volume t · area / 2.
        const double share = m.volume / box, thickness = 2 * m.volume / m.area;
        if (share < little && thickness < thin * norm(size)) {
            workspace.journal.finding(
                {Severity::info, link.work->link->name, "",
                 fmt::format("its material fills {:.0f} % of its box and is {:.2g} mm thick on average: excess is "
                             "relative to that volume; if the link is hollow, hollow: fill counts its inside as "
                             "geometry in the figures and in the allocation",
                             100 * share, 1000 * thickness)});
        }
    }
}

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
        const bool one = names.size() == 1;
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format(
                 "few {} fit {} loosely: {}: excess {}{:.1f}, the robot's is {:.2f}; the allocation goes "
                 "by volume, and small links have little; remedy: budget: {{share: even}}, or links: {{{}: "
                 "{{min_spheres: …}}}}",
                 spheres ? "spheres" : "elements", one ? "a small link" : "small links", first_names(names),
                 one ? "" : "up to ", largest, excess, names.front())});
    }
}

namespace {

/// Returns the robot with the links that `keep` accepts, and their visual geometry as what is to be loaded.
template <class Keep> Robot visual_robot(const Robot& robot, Keep keep) {
    Robot visual = with_covered_geometry(robot, CoveredGeometry::visual);
    std::erase_if(visual.links, [&](const Link& link) { return link.visuals.empty() || !keep(link.name); });
    return visual;
}

/// Loads meshes without a word: what loaders say of visual geometry does not concern the spheres.
std::vector<LinkWork> loaded_in_silence(const Workspace& workspace, const Robot& visual) {
    Journal quiet(nullptr);
    Workspace loading{workspace.recipe, workspace.registry, workspace.options, quiet, workspace.cache};
    loading.limits = workspace.limits;
    loading.phase = workspace.phase;
    std::vector<InputFile> files;
    return load_links(loading, visual, files);
}

} // namespace

void measure_visual_gaps(const Workspace& workspace, const FinishedModel& finished, std::vector<LinkWork>& links) {
    if (workspace.recipe.cover.value_or(CoveredGeometry::collision) != CoveredGeometry::collision ||
        !workspace.recipe.mesh.empty()) {
        return;
    }
    const auto find = [&](const std::string& name) {
        return std::find_if(finished.links.begin(), finished.links.end(),
                            [&](const FinishedLink& link) { return link.work->link->name == name; });
    };
    const Robot visual = visual_robot(*finished.model.robot,
                                      [&](const std::string& name) { return find(name) != finished.links.end(); });
    std::vector<LinkWork> loaded = loaded_in_silence(workspace, visual);
    const StopScope scope(workspace.request());
    parallel_for(loaded.size(), [&](std::size_t i) {
        const FinishedLink& link = *find(loaded[i].link->name);
        VisualGap& gap = links[static_cast<std::size_t>(link.work - links.data())].report.visual_gap.emplace();
        if (loaded[i].error) {
            gap.unknown = loaded[i].error->what();
            return;
        }
        loaded[i].covers = Covers::surface; // a gap is where it is seen
        const Certificate certificate = certify(*solid_of(loaded[i]), link.elements);
        gap.length = certificate.holds ? 0 : certificate.growth;
    });
}

} // namespace foam::inline runtime
