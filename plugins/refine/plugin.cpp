// The refiners whose algorithms are in core/search.
#include <foam/sdk/plugin.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/row_cover.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/search/refine.hpp>

#include <mutex>
#include <optional>

namespace foam::refine {
namespace {

/// Replaces spheres that violate half-space constraints by such as keep them.
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

/// What the parameters of refine.fit say.
struct FitSettings {
    fitted::FitWeights weights;
    std::optional<double> max_gap; ///< m
};

/// Guarantee fitted: moves and sizes spheres so that they differ little from the shape and leave no part of it out.
class Fits final : public Refinement {
public:
    Fits(const Solid& solid, const RefinementGoal& goal, const FitSettings& settings)
        : solid_(solid), settings_(settings), idle_(goal.guarantee != Guarantee::fitted) {
        if (idle_ && settings_.max_gap) {
            throw Error(ErrorCode::usage, "'max_gap' of refine.fit has an effect with guarantee: fitted alone; remedy: "
                                          "write guarantee: fitted, or delete it");
        }
        if (settings_.max_gap && !goal.clip.empty()) {
            throw Error(ErrorCode::usage, "half-space constraints cut spheres off that 'max_gap' of refine.fit needs; "
                                          "remedy: delete 'clip' of the link, or 'max_gap'");
        }
    }

    /// Fits the finest level. Coarser levels remain bounds of it. In deep trees spheres stay near their parents.
    SphereTree refine(SphereTree tree, std::size_t most, Context&) override {
        if (idle_) {
            return tree;
        }
        SphereTree::Level& finest = tree.levels.back();
        const bool flat = tree.levels.size() <= 2;
        try {
            finest.elements.spheres() =
                fitted::fit(solid_, finest.elements.spheres(), most, flat ? fitted::Reach::far : fitted::Reach::near,
                            settings_.weights, settings_.max_gap);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cancelled) {
                throw;
            }
            if (settings_.max_gap) { // the given spheres remain
                const WindUpScope scope;
                finest.elements.spheres() = fitted::within_gap(solid_, finest.elements.spheres(), *settings_.max_gap);
            }
            return tree;
        }
        if (tree.levels.size() > 1 && flat) {
            finest.parents.assign(finest.elements.spheres().size(), 0);
        }
        return tree;
    }

private:
    const Solid& solid_;
    const FitSettings settings_;
    const bool idle_;
};

/// Begins fits with the weights of a recipe.
class BeginsFits final : public Refiner {
public:
    explicit BeginsFits(const Parameters& parameters)
        : settings_{.weights = {.excess = parameters.number("excess"),
                                .missing = parameters.number("missing"),
                                .distance = parameters.number("distance"),
                                .gap = parameters.number("gap")}} {
        const fitted::FitWeights& weights = settings_.weights;
        if (weights.missing + weights.distance + weights.gap == 0) {
            throw Error(ErrorCode::usage, "with 'missing', 'distance' and 'gap' 0, no sphere at all is best; remedy: "
                                          "give one of them a weight above 0");
        }
        if (const double most = parameters.number("max_gap"); most > 0) {
            settings_.max_gap = most;
        }
    }
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override {
        return std::make_unique<Fits>(shape.original(), goal, settings_);
    }

private:
    FitSettings settings_;
};

/// Replaces the spheres of a cylinder or capsule by a row of equal ones along the axis, in closed form, if that has
/// less excess volume.
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

/// Spheres that were split from others keep the root of those.
SphereTree with_finest(const SphereTree& tree, std::vector<Sphere> spheres) {
    SphereTree result = flat_tree(std::move(spheres));
    if (tree.levels.size() > 1) {
        result.levels.front() = tree.levels.front();
    }
    return result;
}

/// Adds spheres one by one, each by splitting one with a plane, while the excess volume falls.
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
            by_spheres::Claim more = splitting_->one_more(next, volume);
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
    by_spheres::Claim begin_with(const std::vector<Sphere>& spheres) const {
        if (spheres == last_.spheres) {
            return last_;
        }
        by_spheres::Claim begin{grown_to_cover(solid_, spheres), 0};
        begin.volume = geometry::joint_volume(solid_, begin.spheres);
        return begin;
    }

    const Solid& solid_;
    const bool idle_;
    std::mutex mutex_;
    by_spheres::Claim last_{{}, 0};                  ///< the result of the last call that added spheres
    std::optional<by_spheres::Splitting> splitting_; ///< made before the first split
};

/// Begins refinements of one kind.
template <class Begun> class Begins final : public Refiner {
public:
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override {
        return std::make_unique<Begun>(shape.original(), goal);
    }
};

} // namespace
} // namespace foam::refine

FOAM_PLUGIN("refine", "1.0", "Apache-2.0") {
    using namespace foam::refine;
    constexpr foam::fitted::FitWeights weights;
    const auto weight = [](const char* name, double usual) {
        return foam::Parameter::number(name, usual).unit("1").bounds(0, 1000);
    };
    enrol.add<BeginsFits>(
        {.name = "refine.fit",
         .summary =
             "Guarantee fitted: moves and sizes spheres so that they differ least from the shape, in all its parts.",
         .reference = "Wang et al. 2006, Variational sphere set approximation for solid objects",
         .revision = foam::fitted::revision,
         .parameters = {
             foam::Parameter::number("excess", weights.excess)
                 .unit("1")
                 .bounds(0.001, 1000)
                 .doc("Weight of the volume of the spheres outside the geometry."),
             weight("missing", weights.missing).doc("Weight of the volume of the geometry outside the spheres."),
             weight("distance", weights.distance)
                 .doc("Weight of the mean distance of the surface from the spheres, times the area of the surface."),
             weight("gap", weights.gap)
                 .doc("Weight of a power mean of these distances, which is near the largest one, times the area."),
             foam::Parameter::number("max_gap", 0)
                 .unit("m")
                 .at_least(0)
                 .doc("Largest distance of a point of the surface from the spheres, which grow where this needs it. "
                      "0: no limit."),
         }});
    enrol.add<Begins<Constraints>>(
        {.name = "refine.clip",
         .summary = "Replaces spheres that violate the half-space constraints of a link (clip).",
         .reference = ""});
    enrol.add<Begins<Rows>>(
        {.name = "refine.row",
         .summary = "Covers a cylinder or capsule by a row of equal spheres, if that has less excess volume.",
         .reference = ""});
    enrol.add<Begins<Splits>>({.name = "refine.split",
                               .summary = "Splits spheres while that reduces the excess volume, up to the budget.",
                               .reference = "Wang et al. 2006, Variational sphere set approximation for solid objects",
                               .revision = 2,
                               .adds_spheres = true});
}
