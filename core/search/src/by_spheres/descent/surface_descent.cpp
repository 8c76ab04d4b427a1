#include "by_spheres/descent/descent.hpp"

#include "by_spheres/measured/points.hpp"
#include "by_spheres/starts/starts.hpp"

#include <algorithm>

namespace foam::inline search::by_spheres {
namespace {

constexpr std::size_t most_border_points = 25; ///< per ball

/// Adds about `count` of some more points, at equal distances in their order; all if they are fewer.
void add_some(Points& points, const Points& more, std::size_t count) {
    const std::size_t stride = 1 + more.size() / count;
    for (std::size_t k = 0; k < more.size(); k += stride) {
        points.add(more, k);
    }
}

} // namespace

std::size_t DescentSurface::pieces_for(std::size_t balls) {
    constexpr std::size_t fewest = 2000, a_ball = 60;
    return std::max(fewest, a_ball * balls);
}

DescentSurface::DescentSurface(const Solid& solid, const Frame& frame, std::size_t balls)
    : skin(solid.surface(), frame, pieces_for(balls)), some(skin.sample(pieces_for(balls) / 5)),
      most(skin.sample(pieces_for(balls) / 3)) {}

DescentSurface::DescentSurface(Points seen, std::size_t balls)
    : skin(std::move(seen)), some(skin.sample(pieces_for(balls) / 5)), most(skin.sample(pieces_for(balls) / 3)) {}

const std::vector<Points>& directions_of_steps() {
    static const std::vector<Points> sets = [] {
        std::vector<Points> made;
        for (std::uint64_t turn = 0; turn < 4; ++turn) {
            made.push_back(spread_directions(64, turn));
        }
        return made;
    }();
    return sets;
}

Balls descended(const DescentSurface& surface, const Occupancy* occupancy, Balls balls, std::size_t count,
                const QuickDescentPlan& plan) {
    PowerCells cells(surface.skin);
    Owners owners;
    if (balls.size() < count) {
        balls = divided(surface.some, std::move(balls), count);
    }
    QuickDescent(directions_of_steps(), occupancy).run(balls, plan, [&](const Balls& now, Points& points, float reach) {
        points.clear();
        cells.find(now, PowerCells::Borders::all);
        add_some(points, cells.borders(), most_border_points * now.size());
        owners.find(surface.most, now);
        float largest = 0;
        for (const Ball& ball : now) {
            largest = std::max(largest, ball.r);
        }
        for (std::size_t p = 0; p < surface.most.size(); ++p) {
            if (owners.power[p] > -2 * largest * reach) {
                points.add(surface.most, p);
            }
        }
    });
    return balls;
}

} // namespace foam::search::by_spheres
