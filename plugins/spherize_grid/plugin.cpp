// spherize.grid: balls around the cells of an oriented grid.
#include "grid_search.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

#include <algorithm>

namespace foam::spherize_grid {
namespace {

SphereTree two_levels(const Sphere& root, std::vector<Sphere> balls) {
    SphereTree tree;
    tree.levels.resize(2);
    tree.levels[0].elements.spheres() = {root};
    tree.levels[1].parents.assign(balls.size(), 0);
    tree.levels[1].elements.spheres() = std::move(balls);
    return tree;
}

/// Returns balls inside the solid in place of the covering ones.
std::vector<Sphere> inner_balls(const std::vector<Cell>& cells, const std::string& name) {
    std::vector<Sphere> balls;
    for (const Cell& cell : cells) {
        check_cancelled();
        if (const auto ball = cell.inner_ball()) {
            balls.push_back(*ball);
        }
    }
    if (balls.empty()) {
        throw Error(ErrorCode::geometry,
                    "spherize.grid: " + name +
                        " has no interior that a sphere would fit in; remedy: guarantee outer or fitted");
    }
    return balls;
}

std::size_t power(std::size_t base, int exponent) {
    std::size_t result = 1;
    for (int i = 0; i < exponent; ++i) {
        result *= base;
    }
    return result;
}

struct Settings {
    std::size_t branch;
    int depth;
    std::size_t most;
    bool refine;
    Cell::Content content;
};

/// The grids of one shape, and their refinements.
class ShapeSearch final : public SphereSearch {
public:
    ShapeSearch(const Shape& shape, const Settings& settings)
        : shape_(shape), settings_(settings), search_(shape.original(), settings.content, settings.refine) {}

    std::vector<SphereTree> at_most(std::span<const Budget> budgets, Context& context) override {
        std::vector<SphereTree> trees;
        for (const Budget& budget : budgets) {
            trees.push_back(at_most(budget, context));
        }
        return trees;
    }

private:
    SphereTree at_most(const Budget& budget, Context& context) {
        const auto flat = [&](std::size_t count) {
            const Grid grid = search_.best(count, context);
            return two_levels(search_.whole().ball(), budget.guarantee == Guarantee::inner
                                                          ? inner_balls(grid.cells, shape_.name())
                                                          : grid.balls);
        };
        if (budget.max_protrusion) {
            return fewest_within(shape_.original(), *budget.max_protrusion, budget.max_spheres.value_or(settings_.most),
                                 flat);
        }
        if (budget.max_spheres) {
            return flat(*budget.max_spheres);
        }
        if (budget.guarantee == Guarantee::inner) { // cells without interior drop out, so they form no tree
            return flat(power(settings_.branch, settings_.depth));
        }
        return nested(context);
    }

    /// Returns a tree with a grid of at most `branch` cells in every cell of the level above.
    SphereTree nested(Context& context) {
        Grid level = search_.best(settings_.branch, context);
        SphereTree tree = two_levels(search_.whole().ball(), level.balls);
        for (int depth = 2; depth <= settings_.depth; ++depth) {
            Grid finer;
            SphereTree::Level& spheres = tree.levels.emplace_back();
            for (std::size_t i = 0; i < level.cells.size(); ++i) {
                context.progress(static_cast<double>(i) / static_cast<double>(level.cells.size()));
                const Cell tight = level.cells[i].in_box(level.cells[i].extent());
                Grid part = best_grid_in(tight, settings_.branch, context);
                if (settings_.refine) {
                    part = Refinement(part).at(settings_.branch, context);
                }
                spheres.parents.insert(spheres.parents.end(), part.cells.size(), static_cast<std::uint32_t>(i));
                std::move(part.cells.begin(), part.cells.end(), std::back_inserter(finer.cells));
                finer.balls.insert(finer.balls.end(), part.balls.begin(), part.balls.end());
            }
            spheres.elements.spheres() = finer.balls;
            level = std::move(finer);
        }
        return tree;
    }

    const Shape& shape_;
    const Settings& settings_;
    Search search_;
};

class GridSpherizer final : public Spherizer {
public:
    explicit GridSpherizer(const Parameters& parameters)
        : settings_{.branch = static_cast<std::size_t>(parameters.integer("branch")),
                    .depth = static_cast<int>(parameters.integer("depth")),
                    .most = static_cast<std::size_t>(parameters.integer("most")),
                    .refine = parameters.boolean("refine"),
                    .content = parameters.text("content") == "solid" ? Cell::Content::solid : Cell::Content::surface} {}

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        return search(shape)->at_most({&budget, 1}, context).front();
    }
    std::unique_ptr<SphereSearch> search(const Shape& shape) const override {
        return std::make_unique<ShapeSearch>(shape, settings_);
    }

private:
    Settings settings_;
};

} // namespace
} // namespace foam::spherize_grid

FOAM_PLUGIN("spherize_grid", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::spherize_grid::GridSpherizer>({
        .name = "spherize.grid",
        .summary = "Balls around the cells of an oriented grid, each the smallest that contains the part of the solid "
                   "in its cell",
        .reference = "Coumar et al. 2025 (grid method of the paper's sphere-tree tool): oriented grid, orientation and "
                     "size optimised",
        .parameters =
            {Parameter::integer("branch", 8)
                 .unit("1")
                 .bounds(1, 512)
                 .doc("Most cells of a grid, where no number of spheres is asked for.")
                 .source("Coumar et al. 2025"),
             Parameter::integer("depth", 1)
                 .unit("1")
                 .bounds(1, 4)
                 .doc("Levels of grids within the cells of the grid above, where no number of spheres is asked for.")
                 .source("Coumar et al. 2025"),
             Parameter::integer("most", 512)
                 .unit("1")
                 .bounds(1, 4096)
                 .doc("Most spheres where only a protrusion is asked for.")
                 .source("a bound on the time of the search"),
             Parameter::boolean("refine", true)
                 .doc("Whether cells are divided further until the number of spheres is used up, where that saves "
                      "volume.")
                 .source("a grid alone leaves up to half of a small budget unused"),
             Parameter::choice("content", {"solid", "surface"}, "solid")
                 .doc("What the balls hold: the solid with its interior, or its surface alone.")
                 .source("metrics: interior outside of the spheres counts as missing")},
        .extensions = {},
        .original_only = true,
    });
}
