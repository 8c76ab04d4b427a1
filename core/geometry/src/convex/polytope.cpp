#include "convex/polytope.hpp"

#include <foam/base/error.hpp>

namespace foam::inline geometry {
namespace {

/// A half-space that a move of a vertex must reach: dot(normal, move) >= least.
struct Demand {
    Vec3 normal;
    double least;
};

/// Returns the least factor, 1 or more, by which the move meets all demands; infinite if none is enough.
double least_factor(std::span<const Demand> demands, const Vec3& move) {
    double factor = 1;
    for (const Demand& demand : demands) {
        const double reached = dot(demand.normal, move);
        factor = std::max(factor, reached > 0 ? demand.least / reached : std::numeric_limits<double>::infinity());
    }
    return factor;
}

/// Returns the shortest move that meets few demands with equality; zero or not finite if there is none.
Vec3 move_to(const Demand& a, const Demand& b) {
    const double c = dot(a.normal, b.normal), d = 1 - c * c;
    return d > 0 ? a.normal * ((a.least - c * b.least) / d) + b.normal * ((b.least - c * a.least) / d) : Vec3{};
}
Vec3 move_to(const Demand& a, const Demand& b, const Demand& c) {
    const Vec3 bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
    return (bc * a.least + ca * b.least + ab * c.least) / dot(a.normal, bc);
}

/// Returns a short move that meets all demands; infinite if there is none. The shortest one meets at most three with
/// equality. Only the first `compared` are tried together; then the move is made longer until it meets the others, too.
Vec3 shortest_move(std::span<const Demand> demands) {
    constexpr std::size_t compared = 12;
    const std::span<const Demand> some = demands.first(std::min(compared, demands.size()));
    double shortest = std::numeric_limits<double>::infinity();
    Vec3 best{shortest, shortest, shortest};
    const auto consider = [&](const Vec3& move) {
        const Vec3 enough = move * least_factor(demands, move);
        if (norm(enough) < shortest) {
            shortest = norm(enough);
            best = enough;
        }
    };
    Vec3 sum{};
    for (const Demand& demand : demands) {
        sum += demand.normal;
    }
    consider(sum);
    for (std::size_t i = 0; i < some.size(); ++i) {
        consider(some[i].normal * some[i].least);
        for (std::size_t k = 0; k < i; ++k) {
            consider(move_to(some[i], some[k]));
            for (std::size_t j = 0; j < k; ++j) {
                consider(move_to(some[i], some[k], some[j]));
            }
        }
    }
    return best;
}

/// Returns the vertices, each moved beyond the planes at it, which are moved outwards. The surface between the moved
/// vertices is beyond these planes everywhere, so their hull contains the polytope between the planes.
std::vector<Vec3> moved_vertices(const Polytope& hull, std::span<const double> lengths, double more) {
    const double near = 1e-9 * bounds(hull.surface).diagonal();
    std::vector<Vec3> result;
    std::vector<Demand> demands;
    for (const Vec3& v : hull.surface.vertices) {
        demands.clear();
        for (std::size_t f = 0; f < hull.faces.size(); ++f) {
            const double below = hull.faces[f].offset - dot(hull.faces[f].normal, v);
            if (below <= near) {
                demands.push_back({hull.faces[f].normal, lengths[f] + below + more});
            }
        }
        result.push_back(v + shortest_move(demands));
    }
    return result;
}

/// Returns whether all planes of the outer polytope are at least `length` away from the points.
bool surrounds(const Polytope& outer, std::span<const Vec3> points, double length) {
    return std::all_of(outer.faces.begin(), outer.faces.end(), [&](const Polytope::Face& face) {
        return std::all_of(points.begin(), points.end(),
                           [&](const Vec3& p) { return dot(face.normal, p) + length <= face.offset; });
    });
}

} // namespace

Vec3 inner_point(const Polytope& hull) {
    const Mesh& mesh = hull.surface;
    Vec3 sum{};
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        const double weight = norm(cross(q - p, r - p));
        sum += (p + q + r) * (weight / 3);
        area += weight;
    }
    return sum / area;
}

std::shared_ptr<const Polytope> with_faces_moved(const Polytope& hull, std::span<const double> lengths,
                                                 std::span<const Vec3> points, double length) {
    const double size = bounds(hull.surface).diagonal() + *std::max_element(lengths.begin(), lengths.end());
    for (double more = 1e-15; more < 1; more *= 8) { // for rounding, and where planes are nearly parallel
        const std::vector<Vec3> vertices = moved_vertices(hull, lengths, more * size);
        if (std::all_of(vertices.begin(), vertices.end(), is_finite)) {
            auto result = convex_hull(vertices);
            if (surrounds(*result, hull.surface.vertices, length) && surrounds(*result, points, length)) {
                return result;
            }
        }
    }
    return nullptr;
}

/// Returns the polytope larger about a point inside; the same triangles and planes.
static std::shared_ptr<const Polytope> scaled(const Polytope& hull, const Vec3& middle, double share) {
    auto result = std::make_shared<Polytope>(hull);
    double reach = 0;
    for (Vec3& v : result->surface.vertices) {
        v += (v - middle) * share;
        reach = std::max(reach, norm(v));
    }
    for (Polytope::Face& face : result->faces) {
        const double rounding = 32 * 0x1p-53 * (reach + norm(middle));
        face.offset += (face.offset - dot(face.normal, middle)) * share + rounding;
    }
    return result;
}

/// Returns the normal of the face from which the farthest vertex is nearest: the direction in which the polytope is
/// thinnest.
static Vec3 thinnest_direction(const Polytope& hull) {
    Vec3 direction{};
    double least = std::numeric_limits<double>::infinity();
    for (const Polytope::Face& face : hull.faces) {
        double thickness = 0;
        for (const Vec3& v : hull.surface.vertices) {
            thickness = std::max(thickness, face.offset - dot(face.normal, v));
        }
        if (thickness < least) {
            least = thickness;
            direction = face.normal;
        }
    }
    return direction;
}

/// Returns a box around the polytope with room for the length, flat where the polytope is; a tetrahedron around one
/// with fewer than 8 vertices, so that there are never more.
static std::shared_ptr<const Polytope> box_with_room(const Polytope& hull, double length) {
    const std::vector<Vec3>& vertices = hull.surface.vertices;
    const auto farthest_from = [&](const Vec3& p) {
        return *std::max_element(vertices.begin(), vertices.end(), [&](const Vec3& a, const Vec3& b) {
            return squared_norm(a - p) < squared_norm(b - p);
        });
    };
    const Vec3 z = thinnest_direction(hull), end = farthest_from(vertices.front());
    const Vec3 along = farthest_from(end) - end;
    const Vec3 x = normalized(along - z * dot(along, z));
    const std::array<Vec3, 3> axes{x, cross(z, x), z};
    const double rounding = 1e-14 * (norm(along) + norm(end) + length);
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3& direction = axes[static_cast<std::size_t>(axis)];
        low[axis] = std::numeric_limits<double>::infinity();
        high[axis] = -low[axis];
        for (const Vec3& v : vertices) {
            low[axis] = std::min(low[axis], dot(direction, v) - length - rounding);
            high[axis] = std::max(high[axis], dot(direction, v) + length + rounding);
        }
    }
    std::vector<Vec3> corners;
    const bool few = vertices.size() < 8;
    for (int i = 0; i < (few ? 4 : 8); ++i) {
        Vec3 corner{};
        for (int axis = 0; axis < 3; ++axis) {
            // A plane through three points three sizes away along the axes is beyond the box's farthest corner.
            const bool far = few ? i == axis + 1 : (i >> axis & 1) != 0;
            const double at = !far ? low[axis] : few ? low[axis] + 3.001 * (high[axis] - low[axis]) : high[axis];
            corner += axes[static_cast<std::size_t>(axis)] * at;
        }
        corners.push_back(corner);
    }
    return convex_hull(corners);
}

/// Returns how far the farthest vertex of the outer polytope is from the nearest of the inner one.
static double reach_beyond(const Polytope& outer, const Polytope& inner) {
    double farthest = 0;
    for (const Vec3& v : outer.surface.vertices) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& w : inner.surface.vertices) {
            nearest = std::min(nearest, distance(v, w));
        }
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

std::shared_ptr<const Polytope> with_room(const Polytope& hull, double length) {
    const Vec3 middle = inner_point(hull);
    double depth = std::numeric_limits<double>::infinity();
    for (const Polytope::Face& face : hull.faces) {
        depth = std::min(depth, face.offset - dot(face.normal, middle));
    }
    const double size = bounds(hull.surface).diagonal();
    constexpr double little = 1e-9, rounding = 1e-2; // shares of the size
    if (depth > 0 && length / depth * (1 + rounding) <= little) {
        return scaled(hull, middle, (length / depth + 1e-15 * (size + norm(middle)) / depth) * (1 + rounding));
    }
    const std::vector<double> lengths(hull.faces.size(), length);
    constexpr double far = 8; // lengths: beyond, faces meet at a sharp edge, which would reach out like a spike
    const auto moved = with_faces_moved(hull, lengths, {}, length);
    if (moved && reach_beyond(*moved, hull) <= far * length) {
        return moved;
    }
    const auto box = box_with_room(hull, length);
    const bool holds = surrounds(*box, hull.surface.vertices, length);
    if (moved && (!holds || signed_volume(moved->surface) <= signed_volume(box->surface))) {
        return moved;
    }
    if (!holds) {
        throw Error(ErrorCode::geometry, "a hull is too thin to be enlarged; remedy: use another kind of element");
    }
    return box;
}

} // namespace foam::inline geometry
