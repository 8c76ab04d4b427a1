#include "body.hpp"

#include <algorithm>

namespace judge {
namespace {

Real to_rounded_box(const Body& body, const Point& q) {
    const Point beyond{std::abs(dot(q, body.place.x)) - body.half.x, std::abs(dot(q, body.place.y)) - body.half.y,
                       std::abs(dot(q, body.place.z)) - body.half.z};
    const Point out{std::max<Real>(beyond.x, 0), std::max<Real>(beyond.y, 0), std::max<Real>(beyond.z, 0)};
    return length(out) + std::min<Real>(std::max({beyond.x, beyond.y, beyond.z}), 0) - body.radius;
}

Real to_cylinder(const Body& body, const Point& q) {
    const Real along = std::abs(dot(q, body.place.z)) - body.half.z,
               across = std::hypot(dot(q, body.place.x), dot(q, body.place.y)) - body.radius;
    return along > 0 && across > 0 ? std::hypot(along, across) : std::max(along, across);
}

Real to_planes(const Body& body, const Point& q, Real enough) {
    Real farthest = -std::numeric_limits<Real>::infinity();
    for (const Body::Plane& plane : body.planes) {
        farthest = std::max(farthest, dot(plane.normal, q) - plane.offset);
        if (farthest > enough) {
            break;
        }
    }
    return farthest;
}

} // namespace

Body ball_at(const Point& center, Real radius) {
    Body body;
    body.place.offset = center;
    body.radius = body.reach = radius;
    return body;
}

Body rounded_box(const Placement& place, const Point& half, Real radius) {
    return {Body::Kind::rounded_box, place, half, radius, {}, length(half) + radius};
}

Body cylinder(const Placement& place, Real half_length, Real radius) {
    return {Body::Kind::cylinder, place, {0, 0, half_length}, radius, {}, std::hypot(half_length, radius)};
}

Real depth(const Body& body, const Point& p, Real enough) {
    const Point q = p - body.place.offset;
    switch (body.kind) {
    case Body::Kind::ball:
        return length(q) - body.radius;
    case Body::Kind::rounded_box:
        return to_rounded_box(body, q);
    case Body::Kind::cylinder:
        return to_cylinder(body, q);
    case Body::Kind::hull:
        return to_planes(body, q, enough);
    }
    return std::numeric_limits<Real>::infinity();
}

} // namespace judge
