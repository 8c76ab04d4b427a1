#include "allocate/allocation.hpp"
#include "promises.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/sdk/kinds.hpp>

#include <thread>

namespace foam::inline runtime {
namespace {

/// Returns the gap: the largest distance from samples of the surface to the elements, m.
double gap(const Solid& solid, const Elements& elements) {
    double worst = 0;
    for (const SurfacePoint& sample : solid.sample_surface(1'000, 5)) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Sphere& sphere : elements.spheres()) {
            nearest = std::min(nearest, distance(sample.point, sphere.center) - sphere.radius);
        }
        for (const Element& element : elements.shaped()) {
            nearest = std::min(nearest, distance(element, sample.point));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

void require_spheres(const Solid& solid, const std::vector<Sphere>& spheres) {
    const double size = solid.bounds().diagonal();
    for (const Sphere& s : spheres) {
        require(is_finite(s.center) && std::isfinite(s.radius),
                fmt::format("a sphere is not finite (center {}, {}, {}, radius {})", s.center.x, s.center.y, s.center.z,
                            s.radius));
        require(s.radius > 0, fmt::format("a sphere has the radius {}; remedy: leave it out", s.radius));
        require(s.radius < 2 * size,
                fmt::format("a sphere has the radius {} m, the whole solid is {} m long", s.radius, size));
    }
}

void require_elements(const Solid& solid, std::span<const Element> elements, const StageInfo& info) {
    const double size = solid.bounds().diagonal();
    for (const Element& element : elements) {
        const std::string noun = with_article(noun_of(element.kind, 1));
        require(knows_all(info.kinds, {element.kind}),
                fmt::format("it makes {}, which StageInfo::kinds lacks; remedy: add Element::Kind::{}", noun,
                            to_string(element.kind)));
        require(is_valid(element), fmt::format("{} is not finite, has no volume, or a rotation that is none", noun));
        const double own = bounds(element).diagonal();
        require(own < 5 * size, fmt::format("{} is {} m long, the whole solid {} m", noun, own, size));
    }
}

void require_tree(const Solid& solid, const SphereTree& tree, std::optional<std::size_t> most, const StageInfo& info) {
    require(!tree.levels.empty() && !tree.elements().empty(), "it gives no sphere at all");
    require(tree.levels[0].elements.spheres().size() == 1 && tree.levels[0].elements.size() == 1 && tree.levels[0].parents.empty(),
            fmt::format("level 0 is not one bounding sphere without a parent, but {} spheres and {} parents; remedy: "
                        "foam::flat_tree()",
                        tree.levels[0].elements.spheres().size(), tree.levels[0].parents.size()));
    require(!most || tree.elements().size() <= *most,
            fmt::format("{} {} in the finest level, {} were allowed; remedy: keep to budget.max_spheres",
                        tree.elements().size(), spheres_alone(info.kinds) ? "spheres" : "elements", most.value_or(0)));
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        const SphereTree::Level& level = tree.levels[l];
        require(l == 0 || level.parents.size() == level.elements.size(),
                fmt::format("level {} has {} {} and {} parents", l, level.elements.size(),
                            level.elements.are_spheres() ? "spheres" : "elements", level.parents.size()));
        for (const std::uint32_t parent : level.parents) {
            require(parent < tree.levels[l - 1].elements.size(),
                    fmt::format("a sphere of level {} has parent {}, but there are {}", l, parent,
                                tree.levels[l - 1].elements.size()));
        }
        require_spheres(solid, level.elements.spheres());
        require_elements(solid, level.elements.shaped(), info);
        const double sticks_out = gap(solid, level.elements), size = solid.bounds().diagonal();
        require(
            sticks_out <= 0.05 * size,
            fmt::format("level {} does not stand for the whole solid: {} m of it stick out, it is {} m long; remedy: "
                        "larger spheres, or more",
                        l, sticks_out, size));
    }
}

/// Runs `look` on every built-in solid. A breach names the first solid.
void on_every_solid(const std::function<void(const Shape&)>& look) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : sample::solids()) {
        names.push_back(name);
    }
    parallel_for(names.size(), [&](std::size_t i) {
        const auto solid = sample::solids().at(names[i])();
        try {
            look(Shape(names[i], solid, solid));
        } catch (const std::exception& error) {
            throw Breach(fmt::format("{}: {}", names[i], error.what()));
        }
    });
}

std::vector<Budget> budgets(const StageInfo& info) {
    std::vector<std::size_t> counts{1, 2, 3, 8, 20};
    if (!spheres_alone(info.kinds)) {
        counts = {1, 2, 3, 4}; // searches for other elements take longer
    }
    std::vector<Budget> result;
    for (const std::size_t count : counts) {
        result.push_back({count, {}, Guarantee::outer});
    }
    return result;
}

void check_budgets(const Spherizer& spherizer, const Shape& shape, const StageInfo& info) {
    QuietContext context{3};
    const Solid& solid = shape.original();
    const std::vector<Budget> wanted = budgets(info);
    const std::unique_ptr<SphereSearch> search = spherizer.search(shape);
    const std::vector<SphereTree> trees = search->at_most(wanted, context);
    require(trees.size() == wanted.size(),
            fmt::format("at_most() of search() gives {} trees for {} budgets", trees.size(), wanted.size()));
    for (std::size_t i = 0; i < trees.size(); ++i) {
        try {
            require_tree(solid, trees[i], wanted[i].max_spheres, info);
            const Elements grown = grown_to_cover(solid, trees[i].elements());
            require(certify(solid, grown).holds, "cover cannot be proved after growth");
        } catch (const std::exception& error) {
            throw Breach(fmt::format("budget of {}: {}", *wanted[i].max_spheres, error.what()));
        }
    }
    require(spherizer.spherize(shape, wanted[3], context) == trees[3], "spherize() gives other spheres than search()");
    require(search->at_most({&wanted[1], 1}, context) == std::vector<SphereTree>{trees[1]},
            fmt::format("search() gives other spheres for {} when it is asked again, after {}; remedy: let a result "
                        "depend on its budget only",
                        *wanted[1].max_spheres, *wanted.back().max_spheres));
}

/// Requires that several elements cost at most what they may.
void check_cost(const Spherizer& spherizer, const Shape& shape, const StageInfo& info) {
    const ElementCost cost;
    for (const double times : {1.0, 3.5}) {
        const double least = least_price(info.kinds, cost);
        QuietContext context{3};
        const Budget budget{.max_spheres = 4, .max_protrusion = {}, .max_cost = times * least, .cost = cost};
        const SphereTree tree = spherizer.spherize(shape, budget, context);
        require_tree(shape.original(), tree, budget.max_spheres, info);
        const double price = price_of(tree.elements(), cost);
        require(tree.elements().size() == 1 || price <= *budget.max_cost * (1 + 1e-9),
                fmt::format("its elements cost {}, {} was allowed; remedy: keep to budget.max_cost", price,
                            *budget.max_cost));
    }
}

Shape shape_of(const std::string& name) {
    const auto solid = sample::solids().at(name)();
    return {name, solid, solid};
}

void check_threads(const Spherizer& spherizer, const Shape& shape) {
    const auto spherize = [&] {
        QuietContext context{3};
        return spherizer.spherize(shape, {8, {}, Guarantee::outer}, context);
    };
    std::array<SphereTree, 2> by_threads;
    with_threads(1, [&] { by_threads[0] = spherize(); });
    with_threads(4, [&] { by_threads[1] = spherize(); });
    require(
        by_threads[0] == by_threads[1],
        fmt::format("{}: 4 threads give other spheres than 1; remedy: results into slots by index, random numbers from "
                    "context.random()",
                    shape.name()));
    std::array<SphereTree, 3> at_once;
    std::array<std::exception_ptr, 3> errors;
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < at_once.size(); ++i) {
            threads.emplace_back([&, i] {
                try {
                    at_once[i] = spherize();
                } catch (...) {
                    errors[i] = std::current_exception();
                }
            });
        }
    }
    for (std::size_t i = 0; i < at_once.size(); ++i) {
        if (errors[i]) {
            std::rethrow_exception(errors[i]);
        }
        require(
            at_once[i] == by_threads[0],
            fmt::format("{}: called by several threads at once it gives other spheres; remedy: keep no state between "
                        "calls",
                        shape.name()));
    }
}

void check_original_only(const Spherizer& spherizer) {
    QuietContext context{3};
    const auto original = sample::solids().at("Bracket")(), other = sample::solids().at("Torus")();
    const Budget budget{4, {}, Guarantee::outer};
    require(spherizer.spherize({"Bracket", original, original}, budget, context) ==
                spherizer.spherize({"Bracket", other, original}, budget, context),
            "another processed mesh gives other spheres; remedy: take Shape::original(), or leave "
            "StageInfo::original_only out");
}

} // namespace

void check_spherizer(const Spherizer& spherizer, const StageInfo& info, Promises& promises) {
    promises.check("keeps the budget, stands for the solid, is proved after growth",
                   [&] { on_every_solid([&](const Shape& shape) { check_budgets(spherizer, shape, info); }); });
    if (!spheres_alone(info.kinds)) {
        promises.check("keeps a budget of cost",
                       [&] { on_every_solid([&](const Shape& shape) { check_cost(spherizer, shape, info); }); });
    }
    promises.check("works without a budget", [&] {
        on_every_solid([&](const Shape& shape) {
            QuietContext context{3};
            require_tree(shape.original(), spherizer.spherize(shape, {}, context), {}, info);
        });
    });
    promises.check("gives the same on any number of threads", [&] {
        check_threads(spherizer, shape_of("Bracket"));
        check_threads(spherizer, shape_of("Torus"));
    });
    if (info.original_only) {
        promises.check("looks at the original alone, as it says", [&] { check_original_only(spherizer); });
    }
    promises.check("stops when asked", [&] {
        require_stop([&](Context& context) {
            spherizer.spherize(shape_of("Torus"), {20, {}, Guarantee::outer}, context);
        });
    });
}

namespace {

/// Returns the objectives of the stage that the runtime knows, by their names.
std::map<std::string, Objective> known_objectives(const StageInfo& info) {
    std::map<std::string, Objective> known;
    for (const Parameter& p : info.parameters) {
        for (const std::string& choice : p.name == info.objective_parameter ? p.choices : std::vector<std::string>()) {
            if (const auto objective = objective_named(choice); objective && objective != Objective::mean_protrusion) {
                known.emplace(choice, *objective);
            }
        }
    }
    return known;
}

void check_least(const RegisteredStage& stage, const Registry& registry,
                 const std::map<std::string, Objective>& objectives) {
    const auto solid = sample::solids().at("Bracket")();
    std::map<std::string, SphereTree> found_by;
    for (const auto& [name, unused] : objectives) {
        QuietContext context{3};
        const auto spherizer =
            registry.make<Spherizer>(stage.info.name, {{stage.info.objective_parameter, ParameterValue(name)}});
        found_by[name] = spherizer->spherize({"Bracket", solid, solid}, {8, {}, Guarantee::outer}, context);
    }
    constexpr double chance = 1.05; // a search may be lucky with another objective
    for (const auto& [name, objective] : objectives) {
        const double own = figure_of(*solid, found_by.at(name).elements(), objective);
        for (const auto& [other, found] : found_by) {
            const double theirs = figure_of(*solid, found.elements(), objective);
            require(own <= chance * theirs,
                    fmt::format("Bracket, 8 spheres: {} is {:.3g} with {}: {}, but {:.3g} with {}; remedy: let "
                                "StageInfo::objective_parameter name the parameter that says what is to be least",
                                name, own, stage.info.objective_parameter, name, theirs, other));
        }
    }
}

} // namespace

void check_objectives(const RegisteredStage& stage, const Registry& registry, Promises& promises) {
    if (const auto objectives = known_objectives(stage.info); objectives.size() > 1) {
        promises.check("has least what its objective says", [&] { check_least(stage, registry, objectives); });
    }
}

} // namespace foam::inline runtime
