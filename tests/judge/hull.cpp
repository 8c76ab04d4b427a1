// Planes of a convex hull by gift wrapping (Chand, Kapur 1970), tried around every pair of points: each edge of a hull
// bears two of its faces. Every plane is moved out until it holds all points. So none cuts off a part of the hull,
// however badly rounding has turned it, and a point beyond one is outside. A plane that was missed could only hide an
// objection; those of faces are found from each of their edges.
#include "body.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace judge {
namespace {

/// Planes that are farther from some point, as a share of the size, are of no face.
constexpr Real loose = 1e-9L;

/// The plane through two points and a third one beyond which there are none.
std::optional<Body::Plane> wrapped(const std::vector<Point>& points, const Point& a, const Point& b) {
    Point normal;
    for (const Point& p : points) {
        const Point n = cross(b - a, p - a);
        const bool first = !(dot(normal, normal) > 0);
        if (first || dot(normal, p - a) > 0) {
            normal = dot(n, n) > 0 ? n : normal;
        }
    }
    const Real size = length(normal);
    if (!(size > 0)) {
        return std::nullopt;
    }
    normal = 1 / size * normal;
    Real farthest = -std::numeric_limits<Real>::infinity();
    for (const Point& p : points) {
        farthest = std::max(farthest, dot(normal, p));
    }
    return Body::Plane{normal, farthest};
}

bool among(const std::vector<Body::Plane>& planes, const Body::Plane& plane) {
    return std::any_of(planes.begin(), planes.end(),
                       [&](const Body::Plane& other) { return length(other.normal - plane.normal) < 1e-15L; });
}

Point mean_of(const std::vector<Point>& points) {
    Point sum;
    for (const Point& p : points) {
        sum = sum + p;
    }
    return 1 / static_cast<Real>(points.size()) * sum;
}

} // namespace

Body hull_of(const std::vector<Point>& corners) {
    Body body;
    body.kind = Body::Kind::hull;
    body.place.offset = mean_of(corners);
    std::vector<Point> points; // each once
    for (const Point& corner : corners) {
        const Point p = corner - body.place.offset;
        if (std::none_of(points.begin(), points.end(), [&](const Point& q) { return length(p - q) == 0; })) {
            points.push_back(p);
        }
        body.reach = std::max(body.reach, length(p));
    }
    for (const Point& a : points) {
        for (const Point& b : points) {
            const auto plane = length(b - a) > 0 ? wrapped(points, a, b) : std::nullopt;
            if (plane && plane->offset - dot(plane->normal, a) <= loose * body.reach && !among(body.planes, *plane)) {
                body.planes.push_back(*plane);
            }
        }
    }
    if (body.planes.size() < 4 ||
        std::any_of(body.planes.begin(), body.planes.end(), [](const Body::Plane& p) { return !(p.offset > 0); })) {
        throw std::runtime_error("the vertices of a hull lie in a plane");
    }
    return body;
}

} // namespace judge
