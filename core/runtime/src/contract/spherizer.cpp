#include "promises.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>

#include <thread>

namespace foam::inline runtime {
namespace {

/// Returns the gap: the largest distance from samples of the surface to the spheres, m.
double gap(const Solid& solid, const std::vector<Sphere>& spheres) {
    double worst = 0;
    for (const SurfacePoint& sample : solid.sample_surface(1'000, 5)) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Sphere& sphere : spheres) {
            nearest = std::min(nearest, distance(sample.point, sphere.center) - sphere.radius);
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

void require_tree(const Solid& solid, const SphereTree& tree, std::optional<std::size_t> most) {
    require(!tree.levels.empty() && !tree.finest().empty(), "it gives no sphere at all");
    require(tree.levels[0].spheres.size() == 1 && tree.levels[0].parents.empty(),
            fmt::format("level 0 is not one bounding sphere without a parent, but {} spheres and {} parents; remedy: "
                        "foam::flat_tree()",
                        tree.levels[0].spheres.size(), tree.levels[0].parents.size()));
    require(!most || tree.finest().size() <= *most,
            fmt::format("{} spheres in the finest level, {} were allowed; remedy: keep to budget.max_spheres",
                        tree.finest().size(), most.value_or(0)));
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        const SphereTree::Level& level = tree.levels[l];
        require(l == 0 || level.parents.size() == level.spheres.size(),
                fmt::format("level {} has {} spheres and {} parents", l, level.spheres.size(), level.parents.size()));
        for (const std::uint32_t parent : level.parents) {
            require(parent < tree.levels[l - 1].spheres.size(),
                    fmt::format("a sphere of level {} has parent {}, but there are {}", l, parent,
                                tree.levels[l - 1].spheres.size()));
        }
        require_spheres(solid, level.spheres);
        const double sticks_out = gap(solid, level.spheres), size = solid.bounds().diagonal();
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

std::vector<Budget> budgets() {
    std::vector<Budget> result;
    for (const std::size_t count : {1, 2, 3, 8, 20}) {
        result.push_back({count, {}, Guarantee::outer});
    }
    return result;
}

void check_budgets(const Spherizer& spherizer, const Shape& shape) {
    QuietContext context{3};
    const Solid& solid = shape.original();
    const std::vector<Budget> wanted = budgets();
    const std::unique_ptr<SphereSearch> search = spherizer.search(shape);
    const std::vector<SphereTree> trees = search->at_most(wanted, context);
    require(trees.size() == wanted.size(),
            fmt::format("at_most() of search() gives {} trees for {} budgets", trees.size(), wanted.size()));
    for (std::size_t i = 0; i < trees.size(); ++i) {
        try {
            require_tree(solid, trees[i], wanted[i].max_spheres);
            require(certify(solid, grown_to_cover(solid, trees[i].finest())).holds,
                    "cover cannot be proved after growth");
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
                   [&] { on_every_solid([&](const Shape& shape) { check_budgets(spherizer, shape); }); });
    promises.check("works without a budget", [&] {
        on_every_solid([&](const Shape& shape) {
            QuietContext context{3};
            require_tree(shape.original(), spherizer.spherize(shape, {}, context), {});
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

} // namespace foam::runtime
