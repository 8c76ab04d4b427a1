#include "proof/bodies.hpp"

#include "convex/kind.hpp"
#include "convex/outside_box.hpp"
#include "convex/polytope.hpp"
#include <foam/geometry/internal/quickhull.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/hypot.hpp>

namespace foam::inline geometry {
namespace {

constexpr double unreachable = std::numeric_limits<double>::infinity();

/// The least radius, m: its square does not lose much to underflow.
constexpr double smallest_radius = 1e-140;

/// Faces of a hull that are tested together, for vector instructions.
constexpr std::size_t faces_at_once = 8;

Vec3 column(const std::array<Vec3, 3>& rows, int axis) {
    return {rows[0][axis], rows[1][axis], rows[2][axis]};
}

/// Returns a bound of the norm of R Rᵀ - 1.
double distortion(const Pose& pose) {
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        for (int k = i; k < 3; ++k) {
            const double wanted = i == k ? 1 : 0;
            most = std::max(most, std::abs(dot(column(pose.rotation, i), column(pose.rotation, k)) - wanted));
            most = std::max(most, std::abs(dot(pose.rotation[static_cast<std::size_t>(i)],
                                               pose.rotation[static_cast<std::size_t>(k)]) -
                                           wanted));
        }
    }
    return 3 * most;
}

bool within(const Vec3& half, const Vec3& p) {
    return std::abs(p.x) <= half.x && std::abs(p.y) <= half.y && std::abs(p.z) <= half.z;
}

double plane_distance(std::span<const Polytope::Face> faces, const Vec3& p) {
    double farthest = -unreachable;
    for (const Polytope::Face& face : faces) {
        farthest = std::max(farthest, dot(face.normal, p) - face.offset);
    }
    return farthest;
}

} // namespace

double reach_from(const Vec3& origin, std::span<const Element> elements) {
    double most = 0;
    for (const Element& e : elements) {
        if (is_valid(e)) {
            const Box box = bounds(e);
            most = std::max(most, distance(box.center(), origin) + box.diagonal() / 2);
        }
    }
    return most;
}

Bodies::Bodies(const Elements& elements, const Vec3& origin, double extent, std::uint32_t most_halvings,
               double caution) {
    const double unit = (2 * unit_roundoff) * (most_halvings + 24) * caution;
    const double placement = 8 * (2 * unit_roundoff) * norm(origin) * caution;
    bodies_.reserve(elements.size());
    CancellationCounter asking(16);
    for (const Element& e : elements) {
        asking.check();
        add(e, origin, extent, unit, placement);
    }
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_[i].sound) {
            rounding_ = std::max(rounding_, 16 * bodies_[i].slack);
            of_.push_back(i);
            boxes.push_back(bodies_[i].bounds);
        }
    }
    bvh_ = Bvh(boxes, 2);
}

void Bodies::meeting(const Box& box, std::vector<std::uint32_t>& result) const {
    result.clear();
    for_each_entered(
        bvh_, [&](const BvhNode& node) { return overlap(node, box); },
        [&](std::uint32_t place) {
            const std::uint32_t i = of_[bvh_.order()[place]];
            if (overlap(bodies_[i].bounds, box)) {
                result.push_back(i);
            }
        });
    std::sort(result.begin(), result.end());
}

void Bodies::add(const Element& element, const Vec3& origin, double extent, double unit, double placement) {
    Body& body = bodies_.emplace_back();
    if (!is_valid(element)) {
        return;
    }
    const std::array<Vec3, 3>& r = element.pose.rotation;
    body.rows = {column(r, 0), column(r, 1), column(r, 2)};
    body.half = element.half;
    body.radius = element.radius;
    body.form = form_of(element);
    if (element.kind == Element::Kind::hull) {
        set_hull(body, element);
    }
    const Vec3 middle = element.pose.rotate(body.middle);
    body.center = middle + element.pose.translation - origin;
    const double reach = reach_of(body);
    const double exact_rotation = 16 * (2 * unit_roundoff); // below it the rows are those of a rotation, rounded
    const double distorted = distortion(element.pose);
    const double off = distorted > exact_rotation ? 2 * distorted : 0;
    body.slack = unit * (extent + norm(body.center) + reach) + placement +
                 8 * (2 * unit_roundoff) * (norm(middle) + norm(element.pose.translation)) + off * reach;
    body.sound = true;
    erode(body, element);
    if (body.sound) {
        const Vec3 room = Vec3{1, 1, 1} * (2 * body.slack);
        const Box box = foam::bounds(element);
        body.bounds.add(box.low - origin - room);
        body.bounds.add(box.high - origin + room);
    }
}

Bodies::Form Bodies::form_of(const Element& element) {
    switch (element.kind) {
    case Element::Kind::sphere:
    case Element::Kind::capsule:
    case Element::Kind::box:
    case Element::Kind::swept_box:
        return Form::round_box;
    case Element::Kind::cylinder:
        return Form::cylinder;
    case Element::Kind::hull:
        return Form::polytope;
    case Element::Kind::ellipsoid:
        break;
    }
    return Form::other;
}

/// Returns the largest distance of a point of the body from its middle.
double Bodies::reach_of(const Body& body) {
    double reach = norm(body.half) + body.radius;
    if (body.hull) {
        for (const Vec3& v : body.hull->surface.vertices) {
            reach = std::max(reach, norm(v - body.middle));
        }
    }
    return reach;
}

void Bodies::set_hull(Body& body, const Element& element) {
    body.hull = convex_hull(element.hull->surface.vertices);
    body.middle = inner_point(*body.hull);
    for (const Polytope::Face& face : body.hull->faces) {
        body.faces.push_back({face.normal, face.offset - dot(face.normal, body.middle)});
    }
    lower_faces(body);
}

/// Sets the faces so that what they enclose lies in the hull of the vertices. A face's plane is put through the lowest
/// corner of the triangles that belong to it. Then a point outside the closed surface is outside of a plane: a segment
/// from the middle to it crosses a triangle, and so leaves the half-space of the face that it belongs to.
void Bodies::lower_faces(Body& body) {
    const std::vector<Vec3>& vertices = body.hull->surface.vertices;
    Box box;
    for (const Vec3& v : vertices) {
        box.add(v);
    }
    const double near = 64 * (2 * unit_roundoff) * box.diagonal();
    const std::size_t count = body.faces.size();
    std::size_t likely = 0; // triangles come in the order of the faces
    for (const auto& [a, b, c] : body.hull->surface.triangles) {
        const auto lowest = [&](std::size_t f) {
            const Vec3& n = body.faces[f].normal;
            return std::min({dot(n, vertices[a] - body.middle), dot(n, vertices[b] - body.middle),
                             dot(n, vertices[c] - body.middle)});
        };
        const auto below = [&](std::size_t f) { return body.faces[f].offset - lowest(f); };
        std::size_t best = likely;
        while (best < count && below(best) > near) {
            ++best;
        }
        if (best < count) {
            likely = best;
        } else { // a triangle whose own plane is far above it, or none
            best = likely;
            for (std::size_t f = 0; f < count; ++f) {
                best = below(f) < below(best) ? f : best;
            }
        }
        body.faces[best].offset = std::min(body.faces[best].offset, lowest(best));
        body.face_of.push_back(static_cast<std::uint32_t>(best));
    }
}

/// Returns the distance from the hull of a point outside a face, which is in the body's frame. Only triangles are
/// looked at whose face has the point outside: the direction from the nearest point is a sum of normals of the faces
/// there, and not all of them have the point inside.
double Bodies::distance_to_hull(const Body& body, const Vec3& q) {
    const Mesh& mesh = body.hull->surface;
    const Vec3 p = q + body.middle;
    double least = unreachable;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Polytope::Face& face = body.faces[body.face_of[i]];
        if (dot(face.normal, q) > face.offset) {
            const auto& [a, b, c] = mesh.triangles[i];
            const Corners t{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
            least = std::min(least, squared_norm(p - closest_on_triangle(t, p)));
        }
    }
    return std::sqrt(least);
}

/// Makes the body smaller by its slack. Nothing is left of what is too large for the argument: with a finite volume, an
/// element whose reach is above 1e112 m is thinner than its slack. Nor is anything left where the slack is not finite.
void Bodies::erode(Body& body, const Element& element) {
    const double s = body.slack;
    const auto to_surface = [&](const Vec3& normal) { // of the body's frame
        return body.rows[0] * normal.x + body.rows[1] * normal.y + body.rows[2] * normal.z;
    };
    if (body.form == Form::polytope) {
        for (Polytope::Face& face : body.faces) {
            face.offset -= s;
            body.sound = body.sound && face.offset > 0;
            body.planes.push_back({to_surface(face.normal), face.offset});
        }
        set_blocks(body);
        return;
    }
    if (body.form == Form::cylinder) {
        body.half.z -= s;
        body.radius -= s;
        body.sound = body.half.z > 0 && body.radius >= smallest_radius;
        return;
    }
    if (body.form == Form::other) {
        body.rest = element;
        body.sound = kind_of(element).erode(body.rest, s);
        return;
    }
    if (body.radius - s >= smallest_radius) {
        body.radius -= s;
        return;
    }
    const double rest = s - body.radius + smallest_radius;
    body.radius = 0;
    body.half = body.half - Vec3{rest, rest, rest};
    body.sound = std::min({body.half.x, body.half.y, body.half.z}) > 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            Vec3 normal{};
            normal[axis] = sign;
            body.planes.push_back({to_surface(normal), body.half[axis]});
        }
    }
}

/// Faces in blocks of eight, the x of their normals first, then y, z and the offsets. The last block is filled up with
/// the last face.
void Bodies::set_blocks(Body& body) {
    for (std::size_t first = 0; first < body.faces.size(); first += faces_at_once) {
        for (int part = 0; part < 4; ++part) {
            for (std::size_t k = first; k < first + faces_at_once; ++k) {
                const Polytope::Face& face = body.faces[std::min(k, body.faces.size() - 1)];
                body.blocks.push_back(part < 3 ? face.normal[part] : face.offset);
            }
        }
    }
}

bool Bodies::below_faces(const Body& body, const Vec3& q, double room) {
    for (std::size_t first = 0; first < body.blocks.size(); first += 4 * faces_at_once) {
        const double* const block = body.blocks.data() + first;
        bool below = true;
        for (std::size_t k = 0; k < faces_at_once; ++k) {
            const double height = block[k] * q.x + block[k + faces_at_once] * q.y + block[k + 2 * faces_at_once] * q.z;
            below = below & (height + room <= block[k + 3 * faces_at_once]);
        }
        if (!below) {
            return false;
        }
    }
    return true;
}

bool Bodies::holds(const Body& body, const Vec3& p, double ball) {
    const Vec3 q = local(body, p);
    switch (body.form) {
    case Form::polytope:
        return below_faces(body, q, ball);
    case Form::other:
        return kind_of(body.rest).holds_ball(body.rest, q, ball);
    case Form::cylinder: {
        const double radius = body.radius - ball;
        return std::abs(q.z) + ball <= body.half.z && radius >= smallest_radius &&
               q.x * q.x + q.y * q.y <= radius * radius;
    }
    case Form::round_box:
        break;
    }
    const double radius = body.radius - ball;
    if (radius >= smallest_radius) {
        return squared_norm(outside_box(body.half, q)) <= radius * radius;
    }
    const double less = ball - body.radius; // at least 0, but for what is below `smallest_radius`
    return within(body.half - Vec3{1, 1, 1} * std::max(less, 0.0), q);
}

bool Bodies::holds(std::uint32_t i, const Piece& piece) const {
    for (const Vec3& corner : PiecePoints(piece)) {
        if (!holds(i, corner)) {
            return false;
        }
    }
    return true;
}

double Bodies::depth(std::uint32_t i, const Vec3& p) const {
    const Body& body = bodies_[i];
    if (!body.sound) {
        return unreachable;
    }
    const Vec3 q = local(body, p);
    if (body.form == Form::polytope) {
        return plane_distance(body.faces, q);
    }
    if (body.form == Form::other) {
        return kind_of(body.rest).signed_distance(body.rest, q);
    }
    if (body.form == Form::cylinder) {
        const double across = foam::hypot(q.x, q.y) - body.radius, along = std::abs(q.z) - body.half.z;
        return std::max(across, along) <= 0 ? std::max(across, along)
                                            : foam::hypot(std::max(across, 0.0), std::max(along, 0.0));
    }
    const Vec3 out = outside_box(body.half, q);
    if (out != Vec3{} || body.radius > 0) {
        return norm(out) - body.radius;
    }
    return std::max({std::abs(q.x) - body.half.x, std::abs(q.y) - body.half.y, std::abs(q.z) - body.half.z});
}

double Bodies::growth(std::uint32_t i, const Vec3& p) const {
    const double out = depth(i, p);
    const Body& body = bodies_[i];
    if (!(out > 0) || !body.hull) {
        return std::max(out, 0.0);
    }
    return std::max(out, distance_to_hull(body, local(body, p)) + 2 * body.slack);
}

void Bodies::choose_near(const Piece& piece, std::size_t begin, std::size_t end,
                         std::vector<std::uint32_t>& near) const {
    const PieceMiddle middle = middle_of(piece);
    double least = unreachable;
    std::vector<double> gaps;
    for (std::size_t k = begin; k < end; ++k) {
        gaps.push_back(growth(near[k], middle.point));
        least = std::min(least, gaps.back());
    }
    const double limit = least + 2.001 * middle.radius;
    for (std::size_t k = begin; k < end; ++k) {
        // What a body needs to hold the middle exceeds its distance by some slack.
        if (gaps[k - begin] <= limit + 4 * slack(near[k])) {
            near.push_back(near[k]);
        }
    }
}

Bodies::Gap Bodies::gap(const Piece& piece, std::span<const std::uint32_t> bodies) const {
    const PiecePoints corners(piece);
    std::array<double, 6> least;
    least.fill(unreachable);
    Gap result{.upper = unreachable};
    for (const std::uint32_t i : bodies) {
        double worst = 0;
        bool holds_all = true;
        for (std::size_t c = 0; c < corners.count; ++c) {
            const bool inside = holds(i, corners.points[c]);
            const double out = inside ? 0 : growth(i, corners.points[c]);
            holds_all = holds_all && inside;
            least[c] = std::min(least[c], out);
            worst = std::max(worst, out);
        }
        if (holds_all) {
            return {.held = true};
        }
        result.upper = std::min(result.upper, worst);
    }
    const auto* const most = std::max_element(least.data(), least.data() + corners.count);
    result.farthest = static_cast<std::size_t>(most - least.data());
    result.lower = *most;
    return result;
}

} // namespace foam::inline geometry
