#include "allocate/budget.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace foam::inline runtime {
namespace {

class Parting {
public:
    Parting(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
            const Goal& goal, ReferencePose& pose)
        : workspace_(workspace), shapes_(shapes), groups_(groups), goal_(goal), pose_(pose),
          allocated_groups_(allocated_groups(shapes, groups)), covering_(workspace, shapes) {}

    /// Returns the overlaps. Their indices refer to the groups without an error.
    std::vector<Overlap> overlaps(const std::vector<std::size_t>& counts) {
        std::vector<ElementsOfLink> all;
        for (std::size_t t = 0; t < allocated_groups_.size(); ++t) {
            all.push_back(spheres_of(t, counts[t]));
        }
        return pose_.overlaps(all);
    }

    /// Restricts the counts of two groups that overlap to counts that do not. The first time the counts found are lower
    /// bounds. The second time they are fixed: with at most as many spheres as the two groups have or need. Unknown
    /// counts are explored, up to eight times the present ones. Returns false if both was done already, or there are no
    /// such counts.
    bool part(const Overlap& overlap, const std::vector<std::size_t>& counts, std::vector<Bounds>& bounds, Cut& cut) {
        int& times = parted_[{overlap.first, overlap.second}];
        if (++times > 2) {
            return false;
        }
        Pair best = best_pair(overlap, bounds, room(overlap), false);
        while (best.depth > 0 && cut == Cut::none && explore_more(overlap, counts, cut)) {
            best = best_pair(overlap, bounds, room(overlap), false);
        }
        if (best.depth > 0) {
            return false;
        }
        if (times == 2) {
            const std::size_t together = std::max(best.sum(), counts[overlap.first] + counts[overlap.second]);
            best = best_pair(overlap, bounds, goal_.enough ? room(overlap) : together, true);
        }
        bounds[overlap.first] = {best.first, times == 2 ? best.first : bounds[overlap.first].most};
        bounds[overlap.second] = {best.second, times == 2 ? best.second : bounds[overlap.second].most};
        return true;
    }

private:
    /// The counts of two groups.
    struct Pair {
        std::size_t first = 0, second = 0;
        double depth = 0;
        Cost cost;

        std::size_t sum() const { return first + second; }
    };

    const ShapeWork& shape_of(std::size_t allocated) const {
        return shapes_[groups_[allocated_groups_[allocated]].shape];
    }

    Cost weighted(std::size_t allocated, const Cost& cost) const {
        return {cost.over, groups_[allocated_groups_[allocated]].weight * cost.volume};
    }

    ElementsOfLink spheres_of(std::size_t allocated, std::size_t count) {
        const Group& group = groups_[allocated_groups_[allocated]];
        return {group.link, covering_.of(group, count)};
    }

    /// Returns the most spheres that two groups can have beside the others.
    std::size_t room(const Overlap& overlap) const {
        std::size_t others = 0;
        for (std::size_t t = 0; t < allocated_groups_.size(); ++t) {
            others += t == overlap.first || t == overlap.second ? 0 : shape_of(t).least;
        }
        return goal_.most - others;
    }

    /// Returns of the known counts within the bounds and the room those with the least overlap; of these, those with
    /// the least excess volume or with the fewest spheres.
    Pair best_pair(const Overlap& overlap, const std::vector<Bounds>& bounds, std::size_t room, bool by_volume) {
        const auto known = [&](std::size_t allocated) {
            return within(shape_of(allocated).known.curve, bounds[allocated]).known();
        };
        const auto order = [&](const Pair& pair) {
            return std::tuple(pair.cost.over, pair.depth, by_volume ? 0 : pair.sum(), pair.cost.volume, pair.sum());
        };
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Pair best{0, 0, infinity, {infinity, infinity}};
        for (const auto& [a, cost_of_a] : known(overlap.first)) {
            const ElementsOfLink first = spheres_of(overlap.first, a);
            for (const auto& [b, cost_of_b] : known(overlap.second)) {
                if (a + b > room) {
                    continue;
                }
                const std::vector<Overlap> found = pose_.overlaps({first, spheres_of(overlap.second, b)});
                const Pair pair{a, b, found.empty() ? 0 : found.front().depth,
                                weighted(overlap.first, cost_of_a) + weighted(overlap.second, cost_of_b)};
                best = order(pair) < order(best) ? pair : best;
            }
        }
        return best;
    }

    bool explore_more(const Overlap& overlap, const std::vector<std::size_t>& counts, Cut& cut) {
        std::vector<std::vector<std::size_t>> wanted(shapes_.size());
        bool any = false;
        for (const std::size_t t : {overlap.first, overlap.second}) {
            const ShapeWork& work = shape_of(t);
            const std::size_t asked = work.known.asked.rbegin()->first;
            const std::size_t most = std::min(most_of(workspace_.recipe, work), goal_.most);
            if (asked < most && asked < 8 * counts[t]) {
                wanted[groups_[allocated_groups_[t]].shape] = rungs_above(work, asked, most);
                any = true;
            }
        }
        cut = any ? explore(workspace_, shapes_, wanted) : cut;
        return any;
    }

    const Workspace& workspace_;
    std::vector<ShapeWork>& shapes_;
    const std::vector<Group>& groups_;
    const Goal& goal_;
    ReferencePose& pose_;
    std::vector<std::size_t> allocated_groups_;
    CoveringElements covering_;
    std::map<std::pair<std::size_t, std::size_t>, int> parted_; ///< restrictions by pair of groups
};

double total_depth(const std::vector<Overlap>& overlaps) {
    double sum = 0;
    for (const Overlap& overlap : overlaps) {
        sum += overlap.depth;
    }
    return sum;
}

} // namespace

Shared keep_apart(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                  const Goal& goal, ReferencePose& pose, Shared shared, Cut& cut) {
    Parting parting(workspace, shapes, groups, goal, pose);
    std::vector<Bounds> bounds(shared.counts.size());
    std::vector<Overlap> overlaps = parting.overlaps(shared.counts);
    Shared best = shared;
    double least = total_depth(overlaps);
    while (least > 0 && cut == Cut::none) {
        bool parted = false;
        for (const Overlap& overlap : overlaps) {
            parted = parting.part(overlap, shared.counts, bounds, cut) || parted;
        }
        if (allocated_groups(shapes, groups).size() != bounds.size()) {
            return share(shapes, groups, goal); // a spherizer failed meanwhile
        }
        if (parted) {
            shared = share(shapes, groups, goal, bounds);
        }
        if (!parted || shared.counts.empty()) {
            break; // there are not enough spheres
        }
        overlaps = parting.overlaps(shared.counts);
        if (const double depth = total_depth(overlaps); depth < least && shared.enough == best.enough) {
            least = depth;
            best = shared;
        }
    }
    return best;
}

void report_overlaps(const Workspace& workspace, const FinishedModel& finished, const std::vector<LinkWork>& links,
                     ReferencePose& pose) {
    std::vector<ElementsOfLink> all;
    for (const FinishedLink& link : finished.links) {
        all.push_back({static_cast<std::size_t>(link.work - links.data()), link.elements});
    }
    for (const Overlap& overlap : pose.overlaps(all)) {
        const bool spheres = finished.links[overlap.first].elements.are_spheres() &&
                             finished.links[overlap.second].elements.are_spheres();
        workspace.journal.finding(
            {Severity::warning, finished.links[overlap.first].work->link->name, "",
             fmt::format("its {0} overlap those of {1} by {2:.3g} m in the pose of self_collision, although the "
                         "geometry of the two links does not touch; remedy: more {0} for both, or max_protrusion",
                         spheres ? "spheres" : "elements", finished.links[overlap.second].work->link->name,
                         overlap.depth)});
    }
}

Elements CoveringElements::of(const Group& group, std::size_t count) {
    return moved(imaged(of_shape(group.shape, count), group.from_shape), group.frame);
}

const Elements& CoveringElements::of_shape(std::size_t shape, std::size_t count) {
    const auto [known, fresh] = known_.try_emplace({shape, count});
    if (fresh) {
        known->second = shapes_[shape].known.trees.at(count).elements();
        if (workspace_.recipe.guarantee == Guarantee::outer) {
            known->second = grown_to_cover(shapes_[shape].shape->original(), std::move(known->second));
        }
    }
    return known->second;
}

} // namespace foam::inline runtime
