#include "allocate/budget.hpp"

#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/internal/links.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace foam::inline runtime {

RandomPoses::RandomPoses(std::shared_ptr<const Robot> robot, const std::vector<LinkWork>& links, std::uint64_t seed)
    : links_(links), robot_(std::move(robot)), kinematics_(robot_) {
    for (const LinkWork& link : links) {
        robot_links_.push_back(static_cast<std::size_t>(link.link - robot_->links.data()));
    }
    configurations_ = random_configurations(kinematics_, count, derive_seed(seed, "budget for poses"));
}

Consequences RandomPoses::consequences(const std::vector<Elements>& of_link) {
    if (solids_.empty()) {
        solids_ = solids_of(*robot_, links_);
    }
    CollisionModel model; // as it is written: with kept spheres and padding
    model.robot = robot_;
    model.elements.resize(robot_->links.size());
    model.sources.resize(robot_->links.size(), CollisionModel::Source::none);
    for (std::size_t i = 0; i < of_link.size(); ++i) {
        const std::size_t link = robot_links_[i];
        const Recipe::LinkRecipe& recipe = links_[i].recipe;
        model.elements[link] = recipe.keep;
        model.elements[link].add(of_link[i]);
        for (Sphere& sphere : model.elements[link].spheres()) {
            sphere.radius += recipe.pad;
        }
        for (Element& element : model.elements[link].shaped()) {
            element = recipe.pad > 0 ? grown(element, recipe.pad) : element;
        }
        model.sources[link] = CollisionModel::Source::given;
    }
    return consequences_of(kinematics_, model, solids_, {}, configurations_);
}

namespace {

/// False contacts of an allocation.
struct FalseContacts {
    std::size_t all = 0;                ///< over pairs of links and poses
    std::vector<std::size_t> of_groups; ///< of the link of each group
};

class AllocationForPoses {
public:
    AllocationForPoses(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                       const Goal& goal, RandomPoses& poses)
        : workspace_(workspace), shapes_(shapes), groups_(groups), goal_(goal), poses_(poses),
          covering_(workspace, shapes) {}

    /// Returns the allocation with the fewest false contacts of some rounds; of equals the earlier one.
    Shared improved(Shared shared, Cut& cut) {
        std::optional<FalseContacts> found = contacts_of(shared, cut);
        if (!found) {
            return shared; // no time to count any
        }
        const std::size_t before = found->all;
        Shared best = shared;
        std::size_t least = before;
        std::vector<Group> weighted = groups_;
        std::set<std::vector<std::size_t>> seen{shared.counts};
        constexpr int rounds = 12;
        for (int round = 0; round < rounds && found && found->all > 0 && cut == Cut::none; ++round) {
            blame(weighted, *found);
            cut = explore_for(workspace_, shapes_, weighted, goal_);
            shared = share(shapes_, weighted, goal_);
            if (shared.counts.size() != best.counts.size()) {
                return share(shapes_, groups_, goal_); // a spherizer failed meanwhile
            }
            if (!seen.insert(shared.counts).second) {
                continue; // the weights grow further
            }
            found = contacts_of(shared, cut);
            if (found && found->all < least) {
                least = found->all;
                best = shared;
            }
        }
        report(before, least);
        return best;
    }

private:
    /// Returns the false contacts; nothing if there was no time.
    std::optional<FalseContacts> contacts_of(const Shared& shared, Cut& cut) {
        const auto counted = measured_in(workspace_, [&] { return counted_in_poses(shared); });
        cut = cut == Cut::none ? workspace_.cut() : cut;
        return counted;
    }

    FalseContacts counted_in_poses(const Shared& shared) {
        std::vector<Elements> of_link(poses_.links()); // kept spheres may be all that a link has
        const std::vector<std::size_t> allocated = allocated_groups(shapes_, groups_);
        for (std::size_t i = 0; i < allocated.size(); ++i) {
            const Group& group = groups_[allocated[i]];
            of_link[group.link].add(covering_.of(group, shared.counts[i]));
        }
        const Consequences found = poses_.consequences(of_link);
        FalseContacts result{0, std::vector<std::size_t>(groups_.size(), 0)};
        for (const PairConsequence& pair : found.pairs) {
            result.all += pair.false_contacts;
            for (std::size_t g = 0; g < groups_.size(); ++g) {
                const std::size_t link = poses_.robot_link(groups_[g].link);
                result.of_groups[g] += link == pair.first || link == pair.second ? pair.false_contacts : 0;
            }
        }
        return result;
    }

    /// Raises the weights of groups by their share of the false contacts: of the one with most of them by `step`.
    static void blame(std::vector<Group>& weighted, const FalseContacts& found) {
        constexpr double step = 4;
        const std::size_t most = *std::max_element(found.of_groups.begin(), found.of_groups.end());
        if (most == 0) {
            return; // they are of kept spheres alone
        }
        for (std::size_t g = 0; g < weighted.size(); ++g) {
            weighted[g].weight *= 1 + (step - 1) * static_cast<double>(found.of_groups[g]) / static_cast<double>(most);
        }
    }

    void report(std::size_t before, std::size_t after) const {
        workspace_.journal.finding(
            {Severity::info, "", "",
             fmt::format("budget.for: poses: {} false contacts of links in {} random poses, {} by volume alone", after,
                         RandomPoses::count, before)});
    }

    const Workspace& workspace_;
    std::vector<ShapeWork>& shapes_;
    const std::vector<Group>& groups_;
    const Goal& goal_;
    RandomPoses& poses_;
    CoveringElements covering_;
};

} // namespace

Shared with_fewer_false_contacts(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                 const std::vector<Group>& groups, const Goal& goal, RandomPoses& poses, Shared shared,
                                 Cut& cut) {
    return AllocationForPoses(workspace, shapes, groups, goal, poses).improved(std::move(shared), cut);
}

} // namespace foam::runtime
