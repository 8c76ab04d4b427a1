#include "refiners.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/geometry/row_cover.hpp>
#include <foam/geometry/volumes.hpp>

namespace foam::refine {
namespace {

class Rows final : public Refinement {
public:
    Rows(const Solid& solid, const RefinementGoal& goal)
        : solid_(solid), idle_(goal.guarantee != Guarantee::outer || goal.objective != Objective::excess ||
                               goal.max_protrusion || !goal.clip.empty()) {}

    SphereTree refine(SphereTree tree, std::size_t most, Context&) override {
        if (idle_ || tree.levels.size() > 2) {
            return tree;
        }
        auto row = geometry::row_cover(solid_, most);
        if (row && volume(*row) < volume(tree.finest())) {
            return flat_tree(std::move(*row));
        }
        return tree;
    }

private:
    double volume(std::vector<Sphere> spheres) const {
        return geometry::joint_volume(solid_, grown_to_cover(solid_, std::move(spheres)));
    }

    const Solid& solid_;
    const bool idle_;
};

} // namespace

std::unique_ptr<Refinement> Row::begin(const Shape& shape, const RefinementGoal& goal) const {
    return std::make_unique<Rows>(shape.original(), goal);
}

} // namespace foam::refine
