#include "by_spheres/portfolio/searches.hpp"

#include "by_spheres/descent/descent.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/surface_runs.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline search::by_spheres {
namespace {

/// Depth of a run in a ball, as a share of its radius, from which on it is left out: balls move less than that.
constexpr double deep = 0.03;
/// Fits until the proof holds. The second and third begin with balls that are right up to what the one before left out.
constexpr int most_fits = 3;
constexpr double least_share_of_pieces = 0.05;

bool holds_deeply(const Sphere& ball, const geometry::SurfaceRuns::Run& run) {
    return distance(ball.center, run.center) + run.radius <= (1 - deep) * ball.radius;
}

/// Returns the runs that lie well inside none of the spheres, whose centres are relative to the middle of the bounds.
std::vector<std::size_t> runs_outside(const geometry::SurfaceRuns& runs, std::span<const Sphere> spheres) {
    std::vector<std::size_t> outside;
    std::vector<Sphere> near;
    for (std::size_t g = 0; g < runs.group_count(); ++g) {
        check_cancelled();
        const geometry::SurfaceRuns::Run& group = runs.group(g);
        if (std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& s) { return holds_deeply(s, group); })) {
            continue;
        }
        near.clear();
        std::copy_if(spheres.begin(), spheres.end(), std::back_inserter(near),
                     [&](const Sphere& s) { return !(distance(s.center, group.center) > s.radius + group.radius); });
        const std::size_t first = g * geometry::SurfaceRuns::group_length;
        for (std::size_t r = first; r < std::min(first + geometry::SurfaceRuns::group_length, runs.size()); ++r) {
            if (std::none_of(near.begin(), near.end(), [&](const Sphere& s) { return holds_deeply(s, runs[r]); })) {
                outside.push_back(r);
            }
        }
    }
    return outside;
}

/// Returns the triangles of some runs.
Mesh mesh_of(const Mesh& surface, const geometry::SurfaceRuns& runs, std::span<const std::size_t> some) {
    constexpr std::uint32_t unnamed = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> name(surface.vertices.size(), unnamed);
    Mesh result;
    for (const std::size_t run : some) {
        for (const std::uint32_t t : runs.triangles(run)) {
            Triangle triangle = surface.triangles[t];
            for (std::uint32_t& corner : triangle) {
                if (name[corner] == unnamed) {
                    name[corner] = static_cast<std::uint32_t>(result.vertices.size());
                    result.vertices.push_back(surface.vertices[corner]);
                }
                corner = name[corner];
            }
            result.triangles.push_back(triangle);
        }
    }
    return result;
}

} // namespace

FineFit::FineFit(const Solid& solid, const Solid& coarse, Effort effort)
    : solid_(solid), coarse_(coarse), frame_(solid.bounds()), plan_(portfolio_of(effort).fit) {}

const Occupancy& FineFit::occupancy() {
    if (!occupancy_) {
        occupancy_.emplace(coarse_, frame_, plan_.resolution);
    }
    return *occupancy_;
}

FineSurface FineFit::skin_around(const std::vector<Sphere>& spheres) const {
    const geometry::SurfaceRuns& runs = geometry::surface_runs(solid_);
    std::vector<Sphere> about_middle = spheres;
    for (Sphere& s : about_middle) {
        s.center -= solid_.bounds().center();
    }
    const Mesh outside = mesh_of(solid_.surface(), runs, runs_outside(runs, about_middle));
    const double share = solid_.area() > 0 ? surface_area(outside) / solid_.area() : 1;
    const auto pieces = static_cast<double>(DescentSurface::pieces_for(spheres.size()));
    FineSurface skin(outside, frame_, static_cast<std::size_t>(std::max(share, least_share_of_pieces) * pieces));
    for (const Vec3& vertex : coarse_.surface().vertices) {
        skin.points.add(frame_.to_unit(vertex));
    }
    return skin;
}

SphereCover FineFit::fitted(const std::vector<Sphere>& spheres) {
    if (spheres.size() == 1) {
        return proved(solid_, frame_, {smallest_ball(solid_, frame_)});
    }
    std::vector<Sphere> now = spheres;
    Balls balls;
    for (int fit = 0; fit < most_fits; ++fit) {
        const FineSurface skin = skin_around(now);
        balls = ConditionalGradient(skin, occupancy()).improved(unit_balls(now, frame_), plan_.steps).balls;
        now = with_a_hair_of_overlap(frame_, balls);
        if (Certificate certificate = certify(solid_, now); certificate.holds) {
            const double volume = exact_union_volume(now);
            return {std::move(now), std::move(certificate), volume};
        }
    }
    return proved(solid_, frame_, balls);
}

} // namespace foam::inline search::by_spheres
