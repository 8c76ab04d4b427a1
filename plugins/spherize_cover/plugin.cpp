// spherize.cover: the covering spheres of foam/search/spherize.hpp as a stage.
#include <foam/base/cancellation.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/search/spherize.hpp>

#include <memory>

namespace {

struct Settings {
    foam::Effort effort;
    foam::Objective objective;
    std::size_t spheres; ///< without a budget
};

/// Returns initial spheres where the runtime fits them: near ones are enough, so the fastest are used.
foam::SphereTree starts_of_fit(const foam::Shape& shape, std::size_t count, foam::Context& context) {
    foam::SphereCover cover = foam::spherize(
        shape.original(), count, {.effort = foam::Effort::fast, .seed = context.seed(), .stop = [] { return true; }});
    return foam::flat_tree(std::move(cover.spheres));
}

/// Returns spheres inside the solid. The runtime reports a solid without room for a ball, for all spherizers.
foam::SphereTree inside(const foam::Shape& shape, std::size_t count, foam::Context& context) {
    std::vector<foam::Sphere> spheres =
        foam::spheres_inside(shape.original(), count, [&] { return context.cancelled(); });
    return spheres.empty() ? starts_of_fit(shape, 1, context) : foam::flat_tree(std::move(spheres));
}

/// Covers of one shape: the search continues when more spheres are requested.
class Search final : public foam::SphereSearch {
public:
    Search(const foam::Shape& shape, const Settings& settings) : shape_(shape), settings_(settings) {}

    std::vector<foam::SphereTree> at_most(std::span<const foam::Budget> budgets, foam::Context& context) override {
        context.check_cancelled();
        const foam::WindUpScope scope; // the search polls the request itself, and returns its result so far
        std::vector<foam::SphereTree> trees;
        for (const foam::Budget& budget : budgets) {
            const std::size_t count = budget.max_spheres.value_or(settings_.spheres);
            trees.push_back(budget.guarantee == foam::Guarantee::outer    ? cover(count, context)
                            : budget.guarantee == foam::Guarantee::fitted ? starts_of_fit(shape_, count, context)
                                                                          : inside(shape_, count, context));
        }
        return trees;
    }

private:
    foam::SphereTree cover(std::size_t count, foam::Context& context) {
        context_ = &context;
        if (!covers_) {
            covers_ = std::make_unique<foam::CoverSearch>(
                shape_.original(), foam::CoverOptions{.effort = settings_.effort,
                                                         .objective = settings_.objective,
                                                         .seed = context.seed(),
                                                         .stop = [this] { return context_->cancelled(); }});
        }
        return foam::flat_tree(covers_->cover(count).elements);
    }

    const foam::Shape& shape_;
    const Settings& settings_;
    foam::Context* context_ = nullptr; ///< of the present call; after its cancellation the result so far covers
    std::unique_ptr<foam::CoverSearch> covers_;
};

class CoverSpherizer final : public foam::Spherizer {
public:
    explicit CoverSpherizer(const foam::Parameters& parameters)
        : settings_{.effort = foam::effort_named(parameters.text("effort")).value(),
                    .objective = foam::objective_named(parameters.text("objective")).value(),
                    .spheres = static_cast<std::size_t>(parameters.integer("spheres"))} {}

    foam::SphereTree spherize(const foam::Shape& shape, const foam::Budget& budget,
                              foam::Context& context) const override {
        return search(shape)->at_most({&budget, 1}, context).front();
    }
    std::unique_ptr<foam::SphereSearch> search(const foam::Shape& shape) const override {
        return std::make_unique<Search>(shape, settings_);
    }

private:
    Settings settings_;
};

} // namespace

FOAM_PLUGIN("spherize_cover", "1.0", "Apache-2.0") {
    enrol.add<CoverSpherizer>({
        .name = "spherize.cover",
        .summary =
            "Covering spheres with the least excess volume: splits by planes, then refinement of all spheres; proved.",
        .reference =
            "Wang et al.: Variational sphere set approximation for solid objects. The Visual Computer 22, 2006",
        .revision = 26,
        .parameters =
            {
                foam::Parameter::choice("effort", {"fast", "normal", "best"}, "normal")
                    .doc("How long to search: fast takes a third to two thirds of the time of normal, best six to "
                         "twenty-five times as long for a few per cent less."),
                foam::Parameter::choice("objective", {"excess", "protrusion", "radius"}, "excess")
                    .doc("What is minimised: the excess volume, the largest protrusion, or the largest radius, for "
                         "planners that use spheres of one radius."),
                foam::Parameter::integer("spheres", 8).bounds(1, 256).doc("Number of spheres without a budget."),
            },
        .original_only = true,
        .objective_parameter = "objective",
    });
}
