#include "refiners.hpp"

#include <foam/base/error.hpp>
#include <foam/search/refine.hpp>

namespace foam::refine {
namespace {

class Fits final : public Refinement {
public:
    Fits(const Solid& solid, const RefinementGoal& goal)
        : solid_(solid), idle_(goal.guarantee != Guarantee::fitted) {}

    /// Fits the finest level. Coarser levels remain bounds of it. In deep trees spheres stay near their parents.
    SphereTree refine(SphereTree tree, std::size_t most, Context&) override {
        if (idle_) {
            return tree;
        }
        SphereTree::Level& finest = tree.levels.back();
        const bool flat = tree.levels.size() <= 2;
        try {
            finest.elements.spheres() = fitted::fit(solid_, finest.elements.spheres(), most, flat ? fitted::Reach::far : fitted::Reach::near);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cancelled) {
                throw;
            }
            return tree; // the given spheres remain
        }
        if (tree.levels.size() > 1 && flat) {
            finest.parents.assign(finest.elements.spheres().size(), 0);
        }
        return tree;
    }

private:
    const Solid& solid_;
    const bool idle_;
};

} // namespace

std::unique_ptr<Refinement> Fit::begin(const Shape& shape, const RefinementGoal& goal) const {
    return std::make_unique<Fits>(shape.original(), goal);
}

} // namespace foam::refine
