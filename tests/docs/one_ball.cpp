#include <foam/sdk/plugin.hpp>

class OneBall final : public foam::Spherizer {
public:
    foam::SphereTree spherize(const foam::Shape& shape, const foam::Budget&, foam::Context& context) const override {
        context.check_cancelled();
        return foam::flat_tree({foam::minimum_enclosing_sphere(shape.original().surface().vertices)});
    }
};

FOAM_PLUGIN("spherize_one_ball", "1.0", "Apache-2.0") {
    enrol.add<OneBall>({.name = "spherize.one_ball", .summary = "The smallest ball around the shape."});
}
