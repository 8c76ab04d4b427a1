// @stage@: leaves out spheres whose place the others fill better once they are grown to cover. A start: the method is to be yours.
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/sdk/plugin.hpp>

namespace {

using namespace foam;

class Leaving final : public Refinement {
public:
    Leaving(const Solid& solid, bool idle) : solid_(solid), idle_(idle) {}

    SphereTree refine(SphereTree tree, std::size_t, Context& context) override {
        if (idle_ || tree.levels.size() > 2) {
            return tree;
        }
        std::vector<Sphere> best = tree.finest();
        double least = volume(best);
        for (std::size_t i = 0; i < best.size() && best.size() > 1;) {
            context.check_cancelled();
            std::vector<Sphere> others = best;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
            const double without = volume(others);
            if (without < least) {
                least = without;
                best = std::move(others);
            } else {
                ++i;
            }
        }
        return flat_tree(std::move(best));
    }

private:
    /// Of the solid and the spheres, grown to cover it; m³. What exceeds the solid's volume is excess.
    double volume(std::vector<Sphere> spheres) const {
        return geometry::joint_volume(solid_, grown_to_cover(solid_, std::move(spheres)));
    }

    const Solid& solid_;
    const bool idle_;
};

class @class@ final : public Refiner {
public:
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override {
        const bool idle = goal.guarantee != Guarantee::outer || goal.objective != Objective::excess || !goal.clip.empty();
        return std::make_unique<Leaving>(shape.original(), idle);
    }
};

} // namespace

FOAM_PLUGIN("@plugin@", "0.1", "Apache-2.0") {
    enrol.add<@class@>({
        .name = "@stage@",
        .summary = "Leaves out spheres whose place the others fill better",
        .reference = "",
    });
}
