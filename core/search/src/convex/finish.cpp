#include "least_fit.hpp"

#include "cloud.hpp"
#include "collapsing_hull.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/geometry/internal/proof.hpp>

#include <limits>

namespace foam::inline search::convex {

Element hull_around(std::vector<Vec3> points, double unit, std::size_t most_vertices) {
    constexpr double spare = 1e-9; // of the size
    const Cloud cloud = cloud_of(points);
    constexpr double flat = 4 * thin;
    Vec3 least_axis{};
    double least = std::numeric_limits<double>::infinity();
    std::vector<Vec3> axes = cloud.normals;
    axes.insert(axes.end(), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
    const auto thickness = [&](const Vec3& axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& p : cloud.points) {
            low = std::min(low, dot(axis, p));
            high = std::max(high, dot(axis, p));
        }
        return high - low;
    };
    for (const Vec3& axis : axes) {
        if (const double t = thickness(axis); t < least) {
            least = t;
            least_axis = axis;
        }
    }
    Element element{.kind = Element::Kind::hull};
    std::vector<Vec3> corners;
    for (const Vec3& p : cloud.points) {
        corners.push_back(cloud.origin + p * cloud.unit);
    }
    if (cloud.flat || least < flat) { // an octahedron about each point
        std::vector<Vec3> thick;
        for (const Vec3& p : corners) {
            for (const Vec3& axis : frame_along(least_axis)) {
                thick.push_back(p - axis * (thin * cloud.unit));
                thick.push_back(p + axis * (thin * cloud.unit));
            }
        }
        corners = std::move(thick);
    }
    element.hull = convex_hull(corners);
    if (element.hull->surface.vertices.size() > most_vertices) {
        element.hull = with_fewer_vertices(*element.hull, most_vertices);
    }
    return grown(element, spare * unit);
}

Cover proved(const Solid& solid, Elements elements) {
    Cover cover;
    cover.certificate = geometry::certify_to_first_gap(solid, elements);
    if (!cover.certificate.holds) {
        elements = grown_to_cover(solid, std::move(elements));
        cover.certificate = certify(solid, elements);
    }
    cover.elements = std::move(elements);
    return cover;
}

double figure_of(const Solid& solid, const Cover& cover, Objective objective) {
    if (objective == Objective::excess) {
        return solid.volume() > 0 ? excess_volume(solid, cover.elements) : union_volume(cover.elements);
    }
    MeasureOptions quick;
    quick.surface_points = 1;
    quick.volume_rays = 1;
    quick.volume_points = 1;
    quick.directions_per_sphere = 200;
    const Measures measures = measure(solid, cover.elements, quick);
    return objective == Objective::protrusion ? measures.protrusion_max : measures.protrusion_mean;
}

} // namespace foam::inline search::convex
