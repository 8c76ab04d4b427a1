#include "proof/surface_pieces.hpp"

#include "convex/polytope.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline geometry {
namespace {

Vec3 unit_vector(int axis, double side) {
    Vec3 v{};
    v[axis] = side;
    return v;
}

} // namespace

ElementSurface::ElementSurface(const Element& element, const Vec3& origin)
    : pose_(element.pose), radius_(element.radius) {
    pose_.translation = pose_.translation - origin;
    inside_ = pose_.translation;
    const Vec3& half = element.half;
    switch (element.kind) {
    case Element::Kind::sphere:
        add_ball({});
        break;
    case Element::Kind::capsule:
        add_ball(half);
        add_edges(2, half);
        break;
    case Element::Kind::cylinder:
        add_edges(2, half);
        for (const double side : {-1.0, 1.0}) { // each end within a square
            SurfacePiece piece;
            piece.count = 4;
            piece.flat = true;
            const double r = radius_, z = side * half.z;
            const std::array<Vec3, 4> square{Vec3{-r, -r, z}, Vec3{r, -r, z}, Vec3{r, r, z}, Vec3{-r, r, z}};
            std::transform(square.begin(), square.end(), piece.corners.begin(), [](const Vec3& p) {
                return SurfacePiece::Corner{p, {}};
            });
            pieces_.push_back(piece);
        }
        break;
    case Element::Kind::box:
        add_faces(half, 0);
        break;
    case Element::Kind::swept_box:
        add_faces(half, radius_);
        if (radius_ > 0) {
            add_ball(half);
            for (int axis = 0; axis < 3; ++axis) {
                add_edges(axis, half);
            }
        }
        break;
    case Element::Kind::hull:
        inside_ = pose_ * inner_point(*element.hull);
        add_hull(*element.hull);
        break;
    case Element::Kind::ellipsoid:
        scale_ = half;
        radius_ = 1;
        add_ball({});
        break;
    }
}

/// Adds the octants of a ball, each moved to its corner of a box.
void ElementSurface::add_ball(const Vec3& half) {
    for (int octant = 0; octant < 8; ++octant) {
        const Vec3 side{octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0};
        const Vec3 base{side.x * half.x, side.y * half.y, side.z * half.z};
        SurfacePiece piece;
        for (int axis = 0; axis < 3; ++axis) {
            piece.corners[static_cast<std::size_t>(axis)] = {base, unit_vector(axis, side[axis])};
        }
        pieces_.push_back(piece);
    }
}

/// Adds quarters of cylinders along the edges of a box that lie along an axis.
void ElementSurface::add_edges(int axis, const Vec3& half) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double first : {-1.0, 1.0}) {
        for (const double second : {-1.0, 1.0}) {
            Vec3 base{};
            base[u] = first * half[u];
            base[v] = second * half[v];
            const Vec3 along = unit_vector(axis, half[axis]), from = unit_vector(u, first), to = unit_vector(v, second);
            pieces_.push_back(
                {.corners = {{{base - along, from}, {base + along, from}, {base + along, to}, {base - along, to}}},
                 .count = 4});
        }
    }
}

/// Adds the faces of a box, moved outwards.
void ElementSurface::add_faces(const Vec3& half, double beyond) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const double side : {-1.0, 1.0}) {
            SurfacePiece piece;
            piece.count = 4;
            piece.flat = true;
            for (std::size_t k = 0; k < 4; ++k) {
                Vec3 p{};
                p[axis] = side * (half[axis] + beyond);
                p[u] = k == 1 || k == 2 ? half[u] : -half[u];
                p[v] = k >= 2 ? half[v] : -half[v];
                piece.corners[k] = {p, {}};
            }
            pieces_.push_back(piece);
        }
    }
}

void ElementSurface::add_hull(const Polytope& hull) {
    for (const auto& [a, b, c] : hull.surface.triangles) {
        const std::vector<Vec3>& v = hull.surface.vertices;
        pieces_.push_back({.corners = {{{v[a], {}}, {v[b], {}}, {v[c], {}}, {}}}, .flat = true});
    }
}

Vec3 ElementSurface::placed(const SurfacePiece::Corner& corner, double reach) const {
    const Vec3 p = corner.base + corner.direction * reach;
    return pose_ * Vec3{p.x * scale_.x, p.y * scale_.y, p.z * scale_.z};
}

/// A point b + r u of the piece has u = v / |v| for some v between the corners' directions uᵢ, so that it lies between
/// b + r v and b + r / |v| · v. With any unit w, |v| >= w · v >= min w · uᵢ. So the corners at the distances r and
/// r / min w · uᵢ have it in their hull.
void ElementSurface::points(const SurfacePiece& piece, std::vector<Vec3>& points) const {
    constexpr double rounding = 1e-15;
    points.clear();
    for (std::size_t k = 0; k < piece.count; ++k) {
        points.push_back(placed(piece.corners[k], radius_ * (1 - rounding)));
    }
    if (piece.flat) {
        return;
    }
    Vec3 middle{};
    for (std::size_t k = 0; k < piece.count; ++k) {
        middle += piece.corners[k].direction;
    }
    middle = normalized(middle);
    double least = 1;
    for (std::size_t k = 0; k < piece.count; ++k) {
        least = std::min(least, dot(middle, piece.corners[k].direction));
    }
    for (std::size_t k = 0; k < piece.count; ++k) {
        points.push_back(placed(piece.corners[k], radius_ / least * (1 + rounding)));
    }
}

void ElementSurface::normals(const SurfacePiece& piece, std::vector<Vec3>& normals) const {
    normals.clear();
    for (std::size_t k = 0; k < (piece.flat ? 0 : piece.count); ++k) {
        const Vec3& d = piece.corners[k].direction;
        normals.push_back(normalized(pose_.rotate({d.x / scale_.x, d.y / scale_.y, d.z / scale_.z})));
    }
}

Vec3 ElementSurface::normal_of_flat(const SurfacePiece& piece) const {
    const auto corner = [&](std::size_t k) { return placed(piece.corners[k], radius_); };
    const Vec3 normal = normalized(cross(corner(1) - corner(0), corner(2) - corner(0)));
    return dot(normal, corner(0) - inside_) < 0 ? -normal : normal;
}

SurfacePiece ElementSurface::flat_piece(const Corners& triangle) const {
    const Pose back = pose_.inverse();
    SurfacePiece piece;
    piece.corners = {{{back * triangle.a, {}}, {back * triangle.b, {}}, {back * triangle.c, {}}, {}}};
    piece.flat = true;
    piece.level = 1;
    return piece;
}

std::array<Vec3, 2> ElementSurface::straight_side(const SurfacePiece& piece) const {
    if (piece.count < 4 || piece.flat) {
        return {};
    }
    const std::size_t side = piece.corners[0].direction == piece.corners[1].direction ? 0 : 1;
    return {placed(piece.corners[side], radius_), placed(piece.corners[side + 1], radius_)};
}

/// Returns the first corner of the side to cut: the longest, but arcs first until they are short.
std::size_t ElementSurface::side_to_cut(const SurfacePiece& piece) const {
    constexpr double short_arc = 0.9; // cosine
    double most = -1;
    std::size_t side = 0;
    for (std::size_t k = 0; k < piece.count; ++k) {
        const SurfacePiece::Corner &a = piece.corners[k], &b = piece.corners[(k + 1) % piece.count];
        if (piece.count == 4 && !piece.flat && dot(a.direction, b.direction) < short_arc) {
            return k;
        }
        const double length = squared_norm(placed(a, radius_) - placed(b, radius_));
        if (length > most) {
            most = length;
            side = k;
        }
    }
    return side;
}

std::pair<SurfacePiece, SurfacePiece> ElementSurface::halves(const SurfacePiece& piece, double share) const {
    std::size_t side = side_to_cut(piece);
    if (share != 0) {
        side = piece.corners[0].direction == piece.corners[1].direction ? 0 : 1;
    }
    const double second_share = share != 0 ? share : 0.5;
    const auto between = [&](std::size_t i, std::size_t k, double of_k) {
        const SurfacePiece::Corner &a = piece.corners[i], &b = piece.corners[k];
        const Vec3 direction = a.direction + b.direction;
        return SurfacePiece::Corner{a.base * (1 - of_k) + b.base * of_k, piece.flat ? Vec3{} : normalized(direction)};
    };
    SurfacePiece first = piece, second = piece;
    first.level = second.level = piece.level + 1;
    const std::size_t next = (side + 1) % piece.count;
    first.corners[next] = second.corners[side] = between(side, next, second_share);
    if (piece.count == 4) {
        const std::size_t third = (side + 2) % 4, last = (side + 3) % 4;
        first.corners[third] = second.corners[last] = between(third, last, 1 - second_share);
    }
    return {first, second};
}

} // namespace foam::inline geometry
