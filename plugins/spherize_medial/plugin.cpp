#include <foam/sdk/plugin.hpp>

#include "best_with_at_most.hpp"
#include "columns.hpp"
#include "stock.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/sdk/stage.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace foam::medial {
namespace {

class MedialSpherizer final : public Spherizer {
public:
    explicit MedialSpherizer(const Settings& settings);
    ~MedialSpherizer() override;

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override;
    std::unique_ptr<SphereSearch> search(const Shape& shape) const override;

private:
    Settings settings_;
};

/// Improves covering balls of the whole surface, ball by ball: all a little, then the one of least cost as far as
/// possible.
std::vector<Sphere> best_cover(const Stock& stock, const std::vector<std::vector<Sphere>>& starts, bool optimise,
                               Context& context) {
    Uncovered uncovered(stock.surface(), stock.dense_points());
    if (!optimise) {
        return uncovered.closed(starts.front(), surface_resolution);
    }
    std::vector<Sphere> best = starts.front();
    if (starts.size() > 1) {
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<Sphere>& start : starts) {
            auto balls = simplex(start, uncovered, stock.columns(), {.sweeps = 1, .settlings = 0}, context);
            const double cost = stock.columns().outside(balls);
            if (cost < least) {
                least = cost;
                best = std::move(balls);
            }
        }
    }
    return simplex(std::move(best), uncovered, stock.columns(), {}, context);
}

/// The spheres of a level and the points that each must contain.
struct Level {
    std::vector<Sphere> balls;
    std::vector<std::uint32_t> parents;
    std::vector<std::vector<Vec3>> points;       ///< for the search; only where there are deeper levels
    std::vector<std::vector<Vec3>> dense_points; ///< to be contained in the end
};

/// Allocates `count` in proportion to `weights`, at least one each, largest quotients first.
std::vector<std::size_t> shares(std::size_t count, const std::vector<double>& weights) {
    std::vector<std::size_t> result(weights.size(), 1);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    // One by one to the largest quotient (Webster's method): monotone in `count`.
    for (std::size_t given = weights.size(); given < count; ++given) {
        std::size_t most = 0;
        for (std::size_t i = 1; i < weights.size(); ++i) {
            const auto owed = [&](std::size_t k) {
                return (total > 0 ? weights[k] : 1.0) / (2.0 * static_cast<double>(result[k]) + 1);
            };
            most = owed(i) > owed(most) ? i : most;
        }
        ++result[most];
    }
    return result;
}

/// Returns how many balls each parent may have: `branch` without a budget, else its share of the level's by cost.
std::vector<std::size_t> children(const Level& above, std::size_t level, const Budget& budget, const Settings& settings,
                                  const Columns& columns) {
    if (!budget.max_spheres) {
        return std::vector<std::size_t>(above.balls.size(), settings.branch);
    }
    const double wanted = std::pow(static_cast<double>(*budget.max_spheres),
                                   static_cast<double>(level) / static_cast<double>(settings.depth));
    const std::size_t count =
        level == settings.depth ? *budget.max_spheres : std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
    std::vector<double> weights;
    for (const Sphere& ball : above.balls) {
        weights.push_back(columns.outside(std::span(&ball, 1)));
    }
    return shares(count, weights);
}

using Groups = std::vector<std::vector<Vec3>>;

/// Assigns each point of a parent to the nearest of the parent's own children, so that a descent in the tree finds it.
/// Grows that child to contain the point, where the optimisation has left it to the children of another parent.
Groups handed_down(const Groups& above, Level& level) {
    std::vector<std::vector<std::size_t>> children(above.size());
    for (std::size_t i = 0; i < level.balls.size(); ++i) {
        children[level.parents[i]].push_back(i);
    }
    Groups below(level.balls.size());
    for (std::size_t parent = 0; parent < above.size(); ++parent) {
        check_cancelled();
        for (const Vec3& p : above[parent]) {
            const auto gap = [&](std::size_t i) { return distance(p, level.balls[i].center) - level.balls[i].radius; };
            const std::size_t nearest =
                *std::min_element(children[parent].begin(), children[parent].end(),
                                  [&](std::size_t a, std::size_t b) { return gap(a) < gap(b); });
            below[nearest].push_back(p);
            Sphere& ball = level.balls[nearest];
            ball.radius = std::max(ball.radius, distance(p, ball.center));
        }
    }
    return below;
}

Level next_level(Stock& stock, const Level& above, std::size_t level, const Budget& budget, const Settings& settings,
                 Context& context) {
    const auto counts = children(above, level, budget, settings, stock.columns());
    const bool optimise = settings.optimise && level <= settings.deepest_optimised_level;
    Level result;
    for (std::size_t i = 0; i < above.balls.size(); ++i) {
        check_cancelled();
        if (above.points[i].empty()) { // needed only for the proof of the level above: unchanged
            result.balls.push_back(above.balls[i]);
            result.parents.push_back(static_cast<std::uint32_t>(i));
            continue;
        }
        const std::vector<std::size_t> count{counts[i]};
        const Region region(above.points[i], stock.touching(above.points[i], context), count, stock.coarse_columns(),
                            settings, context);
        const auto found = starts(stock, region, counts[i], optimise, settings, context);
        for (const Sphere& ball : found.front()) {
            result.balls.push_back(ball);
            result.parents.push_back(static_cast<std::uint32_t>(i));
        }
        context.progress(static_cast<double>(i + 1) / static_cast<double>(above.balls.size()));
    }
    result.balls = best_cover(stock, {result.balls}, optimise, context);
    result.dense_points = handed_down(above.dense_points, result);
    result.points = handed_down(above.points, result);
    return result;
}

Level first_level(const Stock& stock, const Region& region, std::size_t count, const Settings& settings,
                  Context& context) {
    Level result;
    if (count == 1) {
        result.balls = {stock.bounding()};
    } else {
        const bool optimise = settings.optimise && settings.deepest_optimised_level >= 1;
        result.balls = best_cover(stock, starts(stock, region, count, optimise, settings, context), optimise, context);
    }
    result.parents.assign(result.balls.size(), 0);
    if (settings.depth > 1) {
        result.points = handed_down({stock.points()}, result);
        result.dense_points = handed_down({stock.dense_points()}, result);
    }
    return result;
}

std::size_t first_count(const Budget& budget, const Settings& settings) {
    if (!budget.max_spheres) {
        return settings.branch;
    }
    const double wanted = std::pow(static_cast<double>(*budget.max_spheres), 1.0 / static_cast<double>(settings.depth));
    return settings.depth == 1 ? *budget.max_spheres
                               : std::max<std::size_t>(1, static_cast<std::size_t>(wanted + 1e-9));
}

SphereTree::Level in_world(const Frame& frame, const Level& level) {
    SphereTree::Level result;
    for (const Sphere& ball : level.balls) {
        result.elements.spheres().push_back(frame.sphere_to_world(ball));
    }
    result.parents = level.parents;
    return result;
}

SphereTree tree(const Stock& stock, const Level& first) {
    SphereTree result;
    result.levels.push_back({{stock.frame().sphere_to_world(stock.bounding())}, {}});
    result.levels.push_back(in_world(stock.frame(), first));
    return result;
}

/// Returns two levels whatever the depth: balls inside the solid do not correspond to parts of its surface.
SphereTree inner_tree(const Shape& shape, const Stock& stock, std::size_t count, Context& context) {
    Level level;
    level.balls = inner_balls(shape.original(), stock.frame(), stock.columns(), stock.spheres(), count, context);
    if (level.balls.empty()) {
        throw Error(ErrorCode::geometry,
                    shape.name() + " has no interior that a sphere would fit in; remedy: guarantee outer or fitted");
    }
    level.parents.assign(level.balls.size(), 0);
    return tree(stock, level);
}

/// Returns the tree for geometry that is a single point.
SphereTree point_tree(const Shape& shape) {
    const Vec3 p = shape.original().bounds().center();
    const double magnitude = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return flat_tree({Sphere{p, 1e-12 + 1e-15 * magnitude}});
}

/// Returns one tree for each budget. Budgets of similar size share cover points, columns, medial axis and reductions.
std::vector<SphereTree> made(const Shape& shape, std::span<const Budget> budgets, const Settings& settings,
                             Context& context) {
    std::vector<SphereTree> trees(budgets.size());
    if (!(shape.original().bounds().diagonal() > 0)) {
        context.log(Severity::warning, shape.name() + " has no extent: one sphere at its place");
        trees.assign(budgets.size(), point_tree(shape));
        return trees;
    }
    std::map<int, std::vector<std::size_t>> by_tier;
    for (std::size_t i = 0; i < budgets.size(); ++i) {
        const std::size_t finest = budgets[i].max_spheres.value_or(settings.branch);
        by_tier[Stock::tier(finest)].push_back(i);
    }
    for (const auto& [tier, indices] : by_tier) {
        Stock stock(shape, tier, settings, context);
        if (budgets[indices.front()].guarantee == Guarantee::inner) {
            for (const std::size_t i : indices) {
                trees[i] = inner_tree(shape, stock, budgets[i].max_spheres.value_or(settings.branch), context);
            }
            continue;
        }
        std::vector<std::size_t> counts;
        for (const std::size_t i : indices) {
            counts.push_back(first_count(budgets[i], settings));
        }
        std::sort(counts.begin(), counts.end());
        counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
        const Region region(stock.points(), stock.spheres(), counts, stock.coarse_columns(), settings, context);
        std::vector<Level> first(indices.size());
        parallel_for(indices.size(), [&](std::size_t n) {
            first[n] = first_level(stock, region, first_count(budgets[indices[n]], settings), settings, context);
        });
        for (std::size_t n = 0; n < indices.size(); ++n) {
            trees[indices[n]] = tree(stock, first[n]);
            if (settings.depth == 1) {
                continue;
            }
            // Refinement for the regions of one tree must not change the next: the axis is built anew.
            Stock own(shape, tier, settings, context);
            Level level = first[n];
            for (std::size_t depth = 2; depth <= settings.depth; ++depth) {
                level = next_level(own, level, depth, budgets[indices[n]], settings, context);
                trees[indices[n]].levels.push_back(in_world(own.frame(), level));
            }
        }
    }
    return trees;
}

class MedialSearch final : public SphereSearch {
public:
    MedialSearch(const Shape& shape, const Settings& settings) : shape_(shape), settings_(settings) {}

    std::vector<SphereTree> at_most(std::span<const Budget> budgets, Context& context) override {
        if (std::any_of(budgets.begin(), budgets.end(),
                        [](const Budget& budget) { return budget.guarantee == Guarantee::inner; })) {
            return known(budgets, context); // more balls inside never have more missing volume
        }
        return best_with_at_most(shape_.original(), budgets, settings_.compare_with_fewer ? many_fewer : one_or_all,
                                 [&](std::span<const Budget> all) { return known(all, context); });
    }

private:
    /// Returns one tree for each budget, and keeps them: larger budgets are compared with them.
    std::vector<SphereTree> known(std::span<const Budget> budgets, Context& context) {
        const auto key = [](const Budget& budget) { return std::pair(budget.guarantee, budget.max_spheres); };
        std::vector<Budget> missing;
        for (const Budget& budget : budgets) {
            if (!known_.contains(key(budget))) {
                missing.push_back(budget);
            }
        }
        std::vector<SphereTree> fresh = made(shape_, missing, settings_, context);
        for (std::size_t i = 0; i < missing.size(); ++i) {
            known_[key(missing[i])] = std::move(fresh[i]);
        }
        std::vector<SphereTree> trees;
        for (const Budget& budget : budgets) {
            trees.push_back(known_.at(key(budget)));
        }
        return trees;
    }

    const Shape& shape_;
    const Settings& settings_;
    std::map<std::pair<Guarantee, std::optional<std::size_t>>, SphereTree> known_;
};

MedialSpherizer::MedialSpherizer(const Settings& settings) : settings_(settings) {}
MedialSpherizer::~MedialSpherizer() = default;

SphereTree MedialSpherizer::spherize(const Shape& shape, const Budget& budget, Context& context) const {
    return search(shape)->at_most({&budget, 1}, context).front();
}

std::unique_ptr<SphereSearch> MedialSpherizer::search(const Shape& shape) const {
    return std::make_unique<MedialSearch>(shape, settings_);
}

} // namespace
} // namespace foam::medial

using foam::medial::MedialSpherizer;
using foam::medial::Settings;

/// Returns a factory. The stages share one class: they differ in the source of spheres and in their choice.
static foam::StageFactory maker(Settings (*settings)(const foam::Parameters&)) {
    return [settings](const foam::Parameters& parameters, const foam::StageMaker&) {
        return std::make_unique<MedialSpherizer>(settings(parameters));
    };
}

FOAM_PLUGIN("spherize_medial", "1.1", "GPL-3.0-or-later") {
    enrol.add_stage(
        foam::StageKind::spherizer,
        {
            .name = "spherize.medial",
            .summary = "Spheres by reducing an adaptive approximation of the medial axis.",
            .reference =
                "Bradshaw, O'Sullivan: Adaptive medial-axis approximation for sphere-tree construction. ACM TOG 23(1), "
                "2004; Wang et al.: Variational sphere set approximation for solid objects. The Visual Computer 22, "
                "2006",
            .revision = 5,
            .parameters = Settings::medial_parameters(),
            .extensions = {},
        },
        maker(&Settings::of_medial));
    enrol.add_stage(foam::StageKind::spherizer,
                    {
                        .name = "spherize.hubbard",
                        .summary = "Spheres by merging those of a medial axis of evenly spread surface points, each "
                                   "time the pair with the least cost.",
                        .reference = "Hubbard: Approximating polyhedra with spheres for time-critical collision "
                                     "detection. ACM TOG 15(3), 1996",
                        .revision = 3,
                        .parameters = Settings::hubbard_parameters(),
                        .extensions = {},
                    },
                    maker(&Settings::of_hubbard));
    enrol.add_stage(foam::StageKind::spherizer,
                    {
                        .name = "spherize.spawn",
                        .summary = "Spheres that all protrude by the same distance, placed one after another where "
                                   "they contain most of the part that is not covered yet.",
                        .reference = "Bradshaw, O'Sullivan: Adaptive medial-axis approximation for sphere-tree "
                                     "construction. ACM TOG 23(1), 2004, section 5.3 (spawning)",
                        .revision = 3,
                        .parameters = Settings::spawn_parameters(),
                        .extensions = {},
                    },
                    maker(&Settings::of_spawn));
}
