#include "refiners.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/refine.hpp>

#include <mutex>
#include <optional>

namespace foam::refine {
namespace {

/// Spheres that were split from others keep the root of those.
SphereTree with_finest(const SphereTree& tree, std::vector<Sphere> spheres) {
    SphereTree result = flat_tree(std::move(spheres));
    if (tree.levels.size() > 1) {
        result.levels.front() = tree.levels.front();
    }
    return result;
}

class Splits final : public Refinement {
public:
    Splits(const Solid& solid, const RefinementGoal& goal)
        : solid_(solid), idle_(goal.guarantee != Guarantee::outer || goal.objective != Objective::excess ||
                               goal.max_protrusion || !goal.clip.empty() || !(solid.bounds().diagonal() > 0)) {}

    SphereTree refine(SphereTree tree, std::size_t most, Context& context) override {
        if (idle_ || tree.levels.size() > 2 || tree.finest().size() >= most) {
            return tree;
        }
        const std::scoped_lock lock(mutex_);
        try {
            split(tree, most, context);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cancelled) {
                throw;
            }
        }
        return tree;
    }

private:
    /// Splits spheres up to `most`. Keeps a result only if its volume is clearly less: by more than the final growth
    /// may add. On the way the volume may rise: around a ring, two spheres have more excess volume than one.
    void split(SphereTree& tree, std::size_t most, Context& context) {
        constexpr double clearly = 1e-5;
        auto [next, volume] = begin_with(tree.finest());
        double least = volume;
        while (next.size() < most && !context.cancelled()) {
            if (!splitting_) {
                splitting_.emplace(solid_);
            }
            cover::Claim more = splitting_->one_more(next, volume);
            if (more.spheres.size() == next.size()) {
                return;
            }
            next = std::move(more.spheres);
            volume = more.volume;
            if (volume < (1 - clearly) * least) {
                least = volume;
                tree = with_finest(tree, next);
                last_ = {next, volume};
            }
        }
    }

    /// Returns spheres that cover, with their volume. The result of the last call is continued as it is: it covers up
    /// to what the final growth closes, and growth at each step would add up.
    cover::Claim begin_with(const std::vector<Sphere>& spheres) const {
        if (spheres == last_.spheres) {
            return last_;
        }
        cover::Claim begin{grown_to_cover(solid_, spheres), 0};
        begin.volume = geometry::joint_volume(solid_, begin.spheres);
        return begin;
    }

    const Solid& solid_;
    const bool idle_;
    std::mutex mutex_;
    cover::Claim last_{{}, 0};                  ///< the result of the last call that added spheres
    std::optional<cover::Splitting> splitting_; ///< made before the first split
};

} // namespace

std::unique_ptr<Refinement> Split::begin(const Shape& shape, const RefinementGoal& goal) const {
    return std::make_unique<Splits>(shape.original(), goal);
}

} // namespace foam::refine
