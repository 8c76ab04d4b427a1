#include "grid_search.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace foam::spherize_grid {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t directions = 100; // of union_volume(): an error of about 1 %, enough to rank grids

/// Returns the exact grid on a cell; nothing if it has too many cells.
std::optional<Grid> exact(const Cell& cell, const Counts& counts, std::size_t most) {
    Grid grid{cell.divided(counts), {}, 0};
    if (grid.cells.empty() || grid.cells.size() > most) {
        return std::nullopt;
    }
    grid.balls = balls_of(grid.cells);
    grid.volume = union_volume(grid.balls);
    return grid;
}

/// Returns the axes rotated by `angle` about axis number `about`.
Axes turned(const Axes& axes, int about, double angle) {
    const Pose turn = Pose::from_axis_angle(axes[static_cast<std::size_t>(about)], angle);
    return {turn.rotate(axes[0]), turn.rotate(axes[1]), turn.rotate(axes[2])};
}

} // namespace

std::vector<Sphere> balls_of(const std::vector<Cell>& cells) {
    std::vector<Sphere> balls(cells.size());
    parallel_for(cells.size(), [&](std::size_t i) { balls[i] = cells[i].ball(); });
    return balls;
}

Cell quick(const Cell& cell) {
    constexpr std::size_t many = 2'000;
    return cell.pieces() > many ? cell.coarse(cell.box().diagonal() / 50) : cell;
}

GridSearch::GridSearch(const Cell& cell, std::size_t most, Context& context)
    : cell_(cell), size_(cell.box().size()), most_(most), context_(context) {}

double GridSearch::volume(const Counts& counts) {
    const auto [entry, fresh] = seen_.try_emplace(counts, infinity);
    if (fresh) {
        context_.check_cancelled();
        const std::vector<Cell> cells = cell_.divided(counts);
        if (cells.size() <= most_ && !cells.empty()) {
            entry->second = union_volume(balls_of(cells), directions);
        }
    }
    return entry->second;
}

/// Returns the counts whose cells are closest to cubes of the given edge length.
Counts GridSearch::cubic(double edge) const {
    Counts counts;
    for (int axis = 0; axis < 3; ++axis) {
        counts[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(std::lround(size_[axis] / edge)));
    }
    return counts;
}

/// Returns the finest near-cubic grid within the budget, by bisection of the edge length.
Counts GridSearch::largest_cubic() {
    const double longest = std::max({size_.x, size_.y, size_.z});
    // The number of cells in a volume grows as the cube of the resolution, along a surface at least as its first power.
    double coarse = 1, fine = 2 * static_cast<double>(most_) + 1;
    Counts best{1, 1, 1};
    constexpr int steps = 12;
    for (int step = 0; step < steps && longest > 0; ++step) {
        check_cancelled();
        const double resolution = std::sqrt(coarse * fine);
        const Counts counts = cubic(longest / resolution);
        // A grid that is far too fine even by its surface alone need not be computed.
        const double cells = 1.0 * counts[0] * counts[1] * counts[2];
        if (cells <= 64.0 * static_cast<double>(most_) && volume(counts) < infinity) {
            coarse = resolution;
            best = counts;
        } else {
            fine = resolution;
        }
    }
    return best;
}

void GridSearch::climb(Counts start) {
    for (bool better = true; better;) {
        check_cancelled();
        better = false;
        double least = volume(start);
        Counts next = start;
        for (int i = 0; i < 27; ++i) {
            const Counts near{start[0] + i % 3 - 1, start[1] + i / 3 % 3 - 1, start[2] + i / 9 - 1};
            if (std::min({near[0], near[1], near[2]}) >= 1 && volume(near) < least) {
                least = volume(near);
                next = near;
                better = true;
            }
        }
        start = next;
    }
}

std::vector<std::pair<double, Counts>> GridSearch::ranking() {
    volume({1, 1, 1});
    climb(largest_cubic());
    std::vector<std::pair<double, Counts>> ranking;
    for (const auto& [counts, volume] : seen_) {
        if (volume < infinity) {
            ranking.emplace_back(volume, counts);
        }
    }
    std::sort(ranking.begin(), ranking.end());
    return ranking;
}

Grid best_grid_in(const Cell& cell, std::size_t most, Context& context) {
    const Cell rough = quick(cell);
    for (const auto& [volume, counts] : GridSearch(rough, most, context).ranking()) {
        if (auto grid = exact(cell, counts, most)) {
            return std::move(*grid);
        }
    }
    // The exact cell: even one that contains only rounding errors has its place in a tree.
    const Sphere ball = cell.ball();
    return {{cell}, {ball}, union_volume(std::vector<Sphere>{ball})};
}

Grid best_grid(const Cell& whole, const Cell& rough, const Axes& principal, std::size_t most, Context& context) {
    struct Candidate {
        double volume;
        Axes axes;
        Counts counts;
    };
    std::vector<Candidate> candidates;
    for (const Axes& axes : {whole.axes(), principal}) {
        for (const auto& [volume, counts] : GridSearch(rough.turned(axes), most, context).ranking()) {
            candidates.push_back({volume, axes, counts});
        }
    }
    const auto less = [](const Candidate& a, const Candidate& b) { return a.volume < b.volume; };
    std::stable_sort(candidates.begin(), candidates.end(), less);
    for (double angle = 20; angle > 2; angle /= 2) {
        for (int i = 0; i < 6; ++i) {
            context.check_cancelled();
            const Candidate best = candidates.front();
            const Axes axes = turned(best.axes, i / 2, (i % 2 ? -angle : angle) * std::numbers::pi / 180);
            const std::vector<Cell> cells = rough.turned(axes).divided(best.counts);
            const double volume = cells.size() <= most ? union_volume(balls_of(cells), directions) : infinity;
            if (volume < best.volume) {
                candidates.insert(candidates.begin(), {volume, axes, best.counts});
            }
        }
    }
    for (const Candidate& candidate : candidates) {
        if (auto grid = exact(whole.turned(candidate.axes), candidate.counts, most)) {
            return std::move(*grid);
        }
    }
    return *exact(whole, {1, 1, 1}, 1);
}

Search::Search(const Solid& solid, Cell::Content content, bool refine)
    : refine_(refine), whole_(Cell::whole(solid, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, content)),
      rough_(quick(whole_)), principal_(principal_axes(solid)) {}

const Grid& Search::grid(std::size_t most, Context& context) {
    const auto [entry, fresh] = grids_.try_emplace(most);
    if (fresh) {
        entry->second = best_grid(whole_, rough_, principal_, most, context);
    }
    return entry->second;
}

Grid Search::best(std::size_t most, Context& context) {
    if (!refine_) {
        return grid(most, context);
    }
    Grid best;
    for (std::size_t start = 1; start <= most;
         start = start % 3 == 0 ? start / 3 * 4 : std::max(start + 1, start / 2 * 3)) {
        Growth& growth = growths_[start];
        if (!growth.refinement || most < growth.most) {
            growth.refinement = std::make_unique<Refinement>(grid(start, context));
        }
        growth.most = most;
        Grid grown = growth.refinement->at(most, context);
        if (best.cells.empty() || grown.volume < best.volume) {
            best = std::move(grown);
        }
    }
    return best;
}

} // namespace foam::spherize_grid
