// spherize.cover: the covering spheres of foam/search/spherize.hpp as a stage.
#include <foam/base/cancellation.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/search/spherize.hpp>

#include <algorithm>
#include <memory>
#include <mutex>

namespace {

class CoverSpherizer final : public foam::Spherizer {
public:
    explicit CoverSpherizer(const foam::Parameters& parameters)
        : effort_(effort_named(parameters.text("effort"))),
          objective_(foam::objective_named(parameters.text("objective")).value()),
          spheres_(static_cast<std::size_t>(parameters.integer("spheres"))) {}

    foam::SphereTree spherize(const foam::Shape& shape, const foam::Budget& budget,
                              foam::Context& context) const override {
        return spherize_each(shape, {&budget, 1}, context).front();
    }

    std::vector<foam::SphereTree> spherize_each(const foam::Shape& shape, std::span<const foam::Budget> budgets,
                                                foam::Context& context) const override {
        context.check_cancelled();
        const foam::WindUpScope scope; // the search polls the request itself, and returns its result so far
        std::vector<foam::SphereTree> trees(budgets.size());
        bool covers = false;
        for (std::size_t i = 0; i < budgets.size(); ++i) {
            const std::size_t count = budgets[i].max_spheres.value_or(spheres_);
            if (budgets[i].guarantee == foam::Guarantee::fitted) {
                trees[i] = starts_of_fit(shape, count, context);
            } else if (budgets[i].guarantee == foam::Guarantee::inner) {
                trees[i] = inside(shape, count, context);
            } else {
                covers = true;
            }
        }
        if (!covers) {
            return trees;
        }
        const auto run = [&](Kept& kept) {
            kept.context = &context;
            for (std::size_t i = 0; i < budgets.size(); ++i) {
                if (budgets[i].guarantee == foam::Guarantee::outer) {
                    foam::Cover cover = kept.search.cover(budgets[i].max_spheres.value_or(spheres_));
                    trees[i] = foam::flat_tree(std::move(cover.spheres));
                }
            }
        };
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock()) {
            Kept own(shape, *this, context.seed());
            run(own);
            return trees;
        }
        if (!kept_ || !kept_->is_of(shape, context.seed())) {
            kept_ = std::make_unique<Kept>(shape, *this, context.seed());
        }
        run(*kept_);
        return trees;
    }

private:
    /// Returns initial spheres where the runtime fits them: near ones are enough, so the fastest are used.
    static foam::SphereTree starts_of_fit(const foam::Shape& shape, std::size_t count, foam::Context& context) {
        foam::Cover cover =
            foam::spherize(shape.original(), count,
                           {.effort = foam::Effort::fast, .seed = context.seed(), .stop = [] { return true; }});
        return foam::flat_tree(std::move(cover.spheres));
    }

    /// Returns spheres inside the solid. The runtime reports a solid without room for a ball, for all spherizers.
    static foam::SphereTree inside(const foam::Shape& shape, std::size_t count, foam::Context& context) {
        std::vector<foam::Sphere> spheres =
            foam::spheres_inside(shape.original(), count, [&] { return context.cancelled(); });
        return spheres.empty() ? starts_of_fit(shape, 1, context) : foam::flat_tree(std::move(spheres));
    }

    /// A search that continues when more spheres of the same shape are requested.
    struct Kept {
        Kept(const foam::Shape& of, const CoverSpherizer& stage, std::uint64_t s)
            : shape(of), seed(s),
              search(shape.original(),
                     {.effort = stage.effort_, .objective = stage.objective_, .seed = seed, .stop = [this] {
                          return context->cancelled();
                      }}) {}
        bool is_of(const foam::Shape& other, std::uint64_t other_seed) const {
            return &shape.original() == &other.original() && seed == other_seed;
        }

        foam::Shape shape; ///< keeps the solid alive
        std::uint64_t seed;
        foam::Context* context = nullptr; ///< of the present call; after its cancellation the result so far covers
        foam::CoverSearch search;
    };

    static foam::Effort effort_named(const std::string& name) {
        return name == "fast" ? foam::Effort::fast : name == "best" ? foam::Effort::best : foam::Effort::normal;
    }

    foam::Effort effort_;
    foam::Objective objective_;
    std::size_t spheres_;
    mutable std::mutex mutex_; ///< for the kept search; results do not depend on it
    mutable std::unique_ptr<Kept> kept_;
};

} // namespace

FOAM_PLUGIN("spherize_cover", "1.0", "Apache-2.0") {
    enrol.add<CoverSpherizer>({
        .name = "spherize.cover",
        .summary =
            "Covering spheres with the least excess volume: splits by planes, then refinement of all spheres; proved.",
        .reference =
            "Wang et al.: Variational sphere set approximation for solid objects. The Visual Computer 22, 2006",
        .revision = 14,
        .parameters =
            {
                foam::Parameter::choice("effort", {"fast", "normal", "best"}, "normal")
                    .doc("How long to search: fast takes a third of the time of normal, best eight to twenty times as "
                         "long for a few per cent less."),
                foam::Parameter::choice("objective", {"excess", "protrusion", "radius"}, "excess")
                    .doc("What is minimised: the excess volume, the largest protrusion, or the largest radius, for "
                         "planners that use spheres of one radius."),
                foam::Parameter::integer("spheres", 8).bounds(1, 256).doc("Number of spheres without a budget."),
            },
        .original_only = true,
        .objective_parameter = "objective",
    });
}
