#include "by_spheres/portfolio/portfolio.hpp"

#include <array>
#include <cstdint>

namespace foam::inline search::by_spheres {
namespace {

constexpr Plan normal_search() {
    constexpr TwoBallSearch::Plan split{16, 5, 2, 40};
    return {.resolution = 48,
            .points = 3000,
            .first_points = 500,
            .directions = 96,
            .coarse_steps = 120,
            .fine_steps = 120,
            .most_moves = 0,
            .most_moved = 8,
            .most_behind = 1.06,
            .skin_resolution = 16,
            .few = {.quick = true,
                    .restarts = 1,
                    .first_gradient_steps = 2,
                    .last_gradient_steps = 10,
                    .exchange = {split, 20, 4, 12}},
            .some = {.merged = true,
                     .first_gradient_steps = 4,
                     .last_gradient_steps = 20,
                     .exchange = {split, 12, 1, 12}},
            .between = {.grown = true, .first_gradient_steps = 4, .last_gradient_steps = 20},
            .several = {.merged = true, .grown = true, .first_gradient_steps = 4, .last_gradient_steps = 20},
            .many = {.merged = true,
                     .grown = true,
                     .swaps = 2,
                     .first_gradient_steps = 4,
                     .last_gradient_steps = 20}};
}

constexpr Plan best_search() {
    constexpr ExchangePlan exchange{{24, 7, 4, 80}, 80, 12, 20};
    constexpr CountPlan few{.quick = true,
                            .restarts = 12,
                            .kept = 2,
                            .first_gradient_steps = 4,
                            .last_gradient_steps = 40,
                            .exchange = exchange};
    constexpr CountPlan many{.merged = true,
                             .grown = true,
                             .restarts = 3,
                             .first_gradient_steps = 4,
                             .last_gradient_steps = 40,
                             .exchange = exchange};
    Plan plan{.resolution = 48,
              .points = 3000,
              .first_points = 500,
              .directions = 96,
              .coarse_steps = 200,
              .fine_steps = 160,
              .most_moves = 3,
              .most_moved = 12,
              .most_behind = 1.5,
              .skin_resolution = 32,
              .few = few,
              .some = few,
              .between = many,
              .several = many,
              .many = many};
    plan.some.merged = true;
    plan.some.swaps = 48;
    plan.several.swaps = 64;
    plan.many.swaps = 32;
    return plan;
}

constexpr Plan with_moves_of(Plan plan, const Plan& other) {
    plan.most_moves = other.most_moves;
    return plan;
}

/// By Effort.
constexpr std::array<Portfolio, 3> portfolio{{
    {.search = normal_search(),
     .coarse = normal_search(),
     .many = {.starts = {2, 128}, .kept = {1, 1}, .rounds = {2, 512}},
     .objective = {.field = 16,
                   .directions = 64,
                   .evaluations = 24,
                   .random_starts = 1,
                   .kept = 1,
                   .first_rounds = 3,
                   .last_rounds = 12,
                   .moves = 2},
     .fit = {.steps = 8, .resolution = 32}},
    {.search = normal_search(),
     .coarse = with_moves_of(normal_search(), best_search()),
     .many = {.starts = {3, 512}, .kept = {1, 1}, .rounds = {2, SIZE_MAX}},
     .objective = {.field = 24,
                   .directions = 96,
                   .evaluations = 40,
                   .random_starts = 4,
                   .kept = 2,
                   .first_rounds = 6,
                   .last_rounds = 40,
                   .moves = 8},
     .fit = {.steps = 20, .resolution = 48}},
    {.search = best_search(),
     .coarse = best_search(),
     .many = {.starts = {32, 4096}, .kept = {8, 1024}, .rounds = {5, 4096}},
     .objective = {.field = 40,
                   .directions = 128,
                   .evaluations = 64,
                   .random_starts = 24,
                   .kept = 6,
                   .first_rounds = 10,
                   .last_rounds = 80,
                   .moves = 40},
     .fit = {.steps = 40, .resolution = 96}},
}};
static_assert(static_cast<std::size_t>(Effort::best) + 1 == portfolio.size());

} // namespace

const Portfolio& portfolio_of(Effort effort) {
    return portfolio[static_cast<std::size_t>(effort)];
}

} // namespace foam::inline search::by_spheres
