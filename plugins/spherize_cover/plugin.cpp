// The cover of foam/host/spherize.hpp as a stage.
#include <foam/host/spherize.hpp>
#include <foam/plugin.hpp>

namespace {

class CoverSpherizer final : public foam::Spherizer {
public:
    explicit CoverSpherizer(const foam::Parameters& parameters)
        : effort_(effort_named(parameters.text("effort"))),
          spheres_(static_cast<std::size_t>(parameters.integer("spheres"))) {}

    foam::SphereTree spherize(const foam::Shape& shape, const foam::Budget& budget,
                              foam::Context& context) const override {
        return spherize_each(shape, {&budget, 1}, context).front();
    }

    std::vector<foam::SphereTree> spherize_each(const foam::Shape& shape, std::span<const foam::Budget> budgets,
                                                foam::Context& context) const override {
        foam::SpherizeOptions options;
        options.effort = effort_;
        options.seed = context.seed();
        context.check_cancelled();
        options.stop = [&] { return context.cancelled(); }; // what was found until then is a cover, too
        std::vector<std::size_t> counts;
        for (const foam::Budget& budget : budgets) {
            counts.push_back(budget.max_spheres.value_or(spheres_));
        }
        std::vector<foam::SphereTree> trees;
        for (foam::Cover& cover : foam::spherize_each(shape.original(), counts, options)) {
            trees.push_back(foam::flat_tree(std::move(cover.spheres)));
        }
        return trees;
    }

private:
    static foam::Effort effort_named(const std::string& name) {
        return name == "fast" ? foam::Effort::fast : name == "best" ? foam::Effort::best : foam::Effort::normal;
    }

    foam::Effort effort_;
    std::size_t spheres_;
};

} // namespace

FOAM_PLUGIN("spherize_cover", "1.0", "Apache-2.0") {
    enrol.add<CoverSpherizer>({
        .name = "spherize.cover",
        .summary = "Spheres that claim the least volume outside: planes hand the surface to them, two at a time; "
                   "proved.",
        .reference =
            "Wang et al.: Variational sphere set approximation for solid objects. The Visual Computer 22, 2006",
        .revision = 3,
        .parameters =
            {
                foam::Parameter::choice("effort", {"fast", "normal", "best"}, "normal")
                    .doc("How long to look: fast takes about half as long as normal, best fifteen times as long."),
                foam::Parameter::integer("spheres", 8).bounds(1, 256).doc("Number of spheres where no budget says."),
            },
    });
}
