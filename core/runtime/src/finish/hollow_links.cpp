#include "finish/hollow_links.hpp"

#include <fmt/format.h>

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

} // namespace foam::inline runtime
