#include "stock.hpp"

#include "optimise.hpp"

#include <algorithm>
#include <numeric>

namespace foam::medial {
namespace {

std::vector<Corners> local_surface(const Mesh& surface, const Frame& frame) {
    std::vector<Vec3> vertices;
    vertices.reserve(surface.vertices.size());
    for (const Vec3& v : surface.vertices) {
        vertices.push_back(frame.to_local(v));
    }
    std::vector<Corners> result;
    result.reserve(surface.triangles.size());
    for (const auto& [a, b, c] : surface.triangles) {
        result.push_back({vertices[a], vertices[b], vertices[c]});
    }
    return result;
}

Sphere bounding_ball(const std::vector<Corners>& surface) {
    std::vector<Vec3> corners;
    corners.reserve(3 * surface.size());
    for (const Corners& t : surface) {
        corners.insert(corners.end(), t.begin(), t.end());
    }
    return minimum_enclosing_sphere(corners);
}

std::size_t detail(std::size_t count, int tier) {
    return count << static_cast<unsigned>(tier);
}

/// Returns `points`, and about `count` more along the edges, where gaps between balls end and are widest.
std::vector<Vec3> with_edges(const std::vector<Corners>& surface, std::vector<Vec3> points, std::size_t count) {
    double length = 0;
    for (const Corners& t : surface) {
        length += distance(t[0], t[1]) + distance(t[1], t[2]) + distance(t[2], t[0]);
    }
    const double spacing = length / 2 / static_cast<double>(count); // most edges come twice
    for (const Corners& t : surface) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = t[k], &b = t[(k + 1) % 3];
            const auto less = [](const Vec3& p, const Vec3& q) {
                return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
            };
            if (!less(a, b)) {
                continue; // counted by the neighbour
            }
            const double pieces = std::floor(distance(a, b) / spacing);
            for (double i = 1; i < pieces; ++i) {
                points.push_back(a + (b - a) * (i / pieces));
            }
        }
    }
    return points;
}

/// Returns about `count` of the points, evenly from the list.
std::vector<Vec3> every_nth(const std::vector<Vec3>& points, std::size_t count) {
    const std::size_t step = std::max<std::size_t>(1, points.size() / std::max<std::size_t>(count, 1));
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < points.size(); i += step) {
        result.push_back(points[i]);
    }
    return result;
}

/// Radius of a ball that contains no point: fitted() moves it to a useful place.
constexpr double nothing = -1e9;

constexpr std::size_t first_limit = 16; ///< largest count of tier 0; each next tier's is four times as large
constexpr int last_tier = 5;

/// Returns the number of balls of the medial axis at which merging starts: enough for good choices, few enough to try
/// them all. By tier and not by count, so that one sweep of merging serves all counts.
std::size_t merge_start(std::size_t count) {
    return first_limit << (2 * static_cast<unsigned>(Stock::tier(count)) + 2);
}

} // namespace

int Stock::tier(std::size_t count) {
    int result = 0;
    while (result < last_tier && count > first_limit << (2 * static_cast<unsigned>(result))) {
        ++result;
    }
    return result;
}

Stock::Stock(const Shape& shape, int tier, const Settings& settings, Context& context)
    : frame_(principal_frame(shape.original().surface())), surface_(local_surface(shape.original().surface(), frame_)),
      bounding_(bounding_ball(surface_)),
      points_(cover_points(shape.original(), frame_, {detail(settings.cover_points, tier), settings.cover_per_triangle},
                           derive_seed(context.seed(), "cover"))),
      dense_points_(with_edges(surface_, points_, detail(4000, tier))), columns_(shape, frame_, detail(1000, tier)),
      coarse_columns_(shape, frame_, detail(250, tier)), settings_(settings) {
    if (settings.source == Settings::Source::grid) {
        grid_ = grid_seeds(points_, columns_, detail(settings.init_spheres, tier));
    } else {
        make_axis(shape, tier, context);
    }
}

void Stock::make_axis(const Shape& shape, int tier, Context& context) {
    const Solid& solid = shape.processed();
    const CoverOptions options{detail(settings_.site_points, tier), settings_.sites_per_triangle};
    std::vector<Vec3> sites = cover_points(solid, frame_, options, derive_seed(context.seed(), "medial axis"));
    const double step = columns_.step();
    axis_ = std::make_unique<MedialAxis>(std::move(sites), [&solid, this, step](const Sphere& sphere) {
        // The surface is a radius away from a vertex of the diagram: compared with that, columns are fine enough.
        if (solid.closed() && sphere.radius > 1.5 * step) {
            return columns_.inside(sphere.center);
        }
        return solid.contains(frame_.to_world(sphere.center));
    });
    if (settings_.source == Settings::Source::static_axis) {
        axis_->take_all(context);
    } else {
        axis_->refine(detail(settings_.init_spheres, tier), points_, context);
    }
    if (axis_->spheres().empty()) {
        context.log(Severity::warning, "no medial sphere lies inside " + shape.name() +
                                           ": its surface bounds no volume; covering it by balls around groups of its "
                                           "points");
    }
}

std::vector<Sphere> Stock::touching(std::span<const Vec3> points, Context& context) {
    if (!axis_) {
        return touching_seeds(grid_, points);
    }
    if (settings_.source == Settings::Source::adaptive_axis) {
        axis_->refine_region(settings_.min_spheres, settings_.error_factor, points, context);
    }
    return axis_->touching(points);
}

Region::Region(std::vector<Vec3> points, std::span<const Sphere> medial, std::span<const std::size_t> counts,
               const Columns& columns, const Settings& settings, Context& context)
    : points_(std::move(points)), columns_(columns) {
    const std::size_t largest = *std::max_element(counts.begin(), counts.end());
    const auto keep = [&](std::size_t count, std::vector<Sphere> balls) {
        if (!balls.empty()) {
            raw_[count].push_back(std::move(balls));
        }
    };
    if (settings.spawn) {
        Spawn spawn(every_nth(points_, settings.cover_points / 2), medial, columns, largest);
        for (const std::size_t count : counts) {
            keep(count, spawn.cover(count, context));
        }
    }
    std::vector<Sphere> start;
    if (settings.source == Settings::Source::static_axis) {
        start.assign(medial.begin(), medial.end());
    } else if (!medial.empty() && (settings.expand || settings.merge || settings.burst)) {
        Expand expand(every_nth(points_, settings.cover_points / 2), medial);
        if (settings.expand) {
            for (const std::size_t count : counts) {
                context.check_cancelled();
                keep(count, expand.cover(count));
            }
        }
        start = expand.cover(merge_start(largest));
    }
    if (settings.merge && !start.empty()) {
        const auto merged = merge(points_, start, columns, context);
        for (const std::size_t count : counts) {
            keep(count, merged[std::min(count, merged.size()) - 1]);
        }
    }
    if (settings.burst && !start.empty()) {
        for (const std::size_t count : counts) {
            keep(count, burst(points_, start, count, columns, context));
        }
    }
    if (settings.divide || raw_.empty()) { // methods that need no medial axis
        const auto divided = divide(points_, largest, columns, context);
        for (const std::size_t count : counts) {
            keep(count, divided[std::min(count, divided.size()) - 1]);
        }
    }
}

std::vector<std::vector<Sphere>> Region::candidates(std::size_t count) const {
    std::vector<std::vector<Sphere>> result;
    for (std::vector<Sphere> balls : raw_.at(count)) {
        balls.resize(std::min(count, points_.size()), Sphere{balls[0].center, nothing});
        result.push_back(fitted(points_, std::move(balls), columns_, 4));
    }
    std::stable_sort(result.begin(), result.end(),
                     [&](const auto& a, const auto& b) { return columns_.outside(a) < columns_.outside(b); });
    return result;
}

/// Returns the balls with the least important one removed, and the ball that is then largest split in two. Descent does
/// not find such changes.
static std::vector<Sphere> with_one_moved(std::span<const Vec3> points, const std::vector<Sphere>& balls,
                                          const Columns& columns) {
    constexpr std::size_t tried = 8; // the smallest
    std::vector<std::size_t> order(balls.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return balls[a].radius < balls[b].radius; });
    order.resize(std::min(order.size(), tried));
    std::vector<Sphere> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        std::vector<Sphere> moved = balls;
        moved[i].radius = nothing;
        moved = fitted(points, std::move(moved), columns, 2);
        if (const double cost = columns.outside(moved); cost < least) {
            least = cost;
            best = std::move(moved);
        }
    }
    return best;
}

std::vector<std::vector<Sphere>> starts(const Stock& stock, const Region& region, std::size_t count, bool optimise,
                                        const Settings& settings, Context& context) {
    auto candidates = region.candidates(count);
    const std::vector<Sphere> reduced = candidates.front();
    const bool descent = settings.optimiser == Settings::Optimiser::variational && settings.tester_points > 0;
    if (!optimise || (!descent && settings.optimiser != Settings::Optimiser::balance)) {
        return {reduced};
    }
    const Columns& columns = stock.columns();
    if (settings.optimiser == Settings::Optimiser::balance) {
        return {balance(region.points(), reduced, settings.balance_excess, columns, context)};
    }
    const DescentOptions options{.directions = settings.tester_points};
    std::vector<Sphere> best;
    double least = std::numeric_limits<double>::infinity();
    const auto descend = [&](const std::vector<Sphere>& start) {
        auto balls = variational(region.points(), start, columns, options, context);
        const double cost = columns.outside(balls);
        const bool better = cost < least;
        if (better) {
            least = cost;
            best = std::move(balls);
        }
        return better;
    };
    for (const std::vector<Sphere>& candidate : candidates) {
        descend(candidate);
    }
    constexpr int moves = 6;
    // Not where balls are parents: moved balls would divide their surface worse.
    bool better = best.size() > 1 && settings.depth == 1;
    for (int i = 0; i < moves && better; ++i) {
        better = descend(with_one_moved(region.points(), best, stock.coarse_columns()));
    }
    return {std::move(best), reduced};
}

} // namespace foam::medial
