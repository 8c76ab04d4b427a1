// @stage@: balls around equal slices of the shape along its longest axis. A start: the method is to be yours.
#include <foam/geometry/cell.hpp>
#include <foam/sdk/plugin.hpp>

namespace {

using namespace foam;

class @class@ final : public Spherizer {
public:
    explicit @class@(const Parameters& parameters) : slices_(parameters.integer("slices")) {}

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        const Solid& solid = shape.original(); // metres, frame of the link
        const auto count = budget.max_spheres ? static_cast<std::int64_t>(*budget.max_spheres) : slices_;
        const int slices = static_cast<int>(std::min<std::int64_t>(count, 10'000));
        std::vector<Sphere> balls;
        for (const Cell& cell : Cell::whole(solid, principal_axes(solid), Cell::Content::solid).divided({slices, 1, 1})) {
            context.check_cancelled();
            balls.push_back(cell.ball());
        }
        return flat_tree(std::move(balls));
    }

private:
    std::int64_t slices_;
};

} // namespace

FOAM_PLUGIN("@plugin@", "0.1", "Apache-2.0") {
    enrol.add<@class@>({
        .name = "@stage@",
        .summary = "Balls around equal slices of the shape along its longest axis",
        .reference = "",
        .parameters = {Parameter::integer("slices", 8)
                           .unit("1")
                           .bounds(1, 10'000)
                           .doc("Number of spheres, where the recipe has no budget.")},
        .original_only = true, // no look at shape.processed(): mesh filters before it change nothing
    });
}
