#include "refiners.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/search/refine.hpp>

namespace foam::refine {
namespace {

class Constraints final : public Refinement {
public:
    Constraints(const Solid& solid, const RefinementGoal& goal) : solid_(solid), goal_(goal) {}

    /// Makes the finest level keep the half-space constraints if it does not. Removes coarser levels except the root.
    SphereTree refine(SphereTree tree, std::size_t most, Context& context) override {
        if (goal_.clip.empty()) {
            return tree;
        }
        const bool outer = goal_.guarantee == Guarantee::outer;
        if (keep_constraints(solid_, outer ? grown_to_cover(solid_, tree.finest()) : tree.finest(), goal_.clip)) {
            return tree;
        }
        if (outer) {
            return flat_tree(covering_within(solid_, tree.finest(), most, goal_.clip, context.seed()));
        }
        std::vector<Sphere> left = shrunk_within(solid_, tree.finest(), goal_.clip);
        return left.empty() ? tree : flat_tree(std::move(left));
    }

private:
    const Solid& solid_;
    const RefinementGoal goal_;
};

} // namespace

std::unique_ptr<Refinement> Clip::begin(const Shape& shape, const RefinementGoal& goal) const {
    return std::make_unique<Constraints>(shape.original(), goal);
}

} // namespace foam::refine
