#include "proof/cover.hpp"

#include "convex/kind.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <optional>

namespace foam::inline geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds on the radius, m. Squares of distances within balls of these sizes neither overflow nor lose more than 1e-40
/// of themselves to underflow. Other balls contain nothing.
constexpr double smallest_ball = 1e-140, largest_ball = 1e150;

double squared_reach(const Vec3& center, const Corners& t) {
    return std::max({squared_norm(t.a - center), squared_norm(t.b - center), squared_norm(t.c - center)});
}

double squared_edge(const Corners& t) {
    return std::max({squared_norm(t.b - t.a), squared_norm(t.c - t.b), squared_norm(t.a - t.c)});
}

double squared_height(const Piece& piece) {
    const Corners &top = piece.corners, &base = piece.beneath;
    return piece.curved
               ? std::max({squared_norm(top.a - base.a), squared_norm(top.b - base.b), squared_norm(top.c - base.c)})
               : 0;
}

/// Sets both halves of a triangle; `cut` is the edge: 0 ab, 1 bc, 2 ca.
void halve(Corners& first, Corners& second, int cut) {
    if (cut == 0) {
        first.b = second.a = (first.a + first.b) * 0.5;
    } else if (cut == 1) {
        first.c = second.b = (first.b + first.c) * 0.5;
    } else {
        first.c = second.a = (first.c + first.a) * 0.5;
    }
}

/// Returns whether a piece is a strip: the hull of two segments, each a triangle with two equal corners.
bool is_strip(const Piece& piece) {
    return piece.curved && piece.corners.b == piece.corners.c && piece.beneath.b == piece.beneath.c;
}

/// Returns the halves of the strip between the segments from a to b and from c to d.
std::pair<Piece, Piece> halves_of_strip(const Piece& piece, const Vec3& a, const Vec3& b, const Vec3& c,
                                        const Vec3& d) {
    const Vec3 m = (a + b) * 0.5, n = (c + d) * 0.5;
    Piece first = piece, second = piece;
    first.curved = second.curved = true;
    first.corners = {a, m, m};
    first.beneath = {c, n, n};
    second.corners = {m, b, b};
    second.beneath = {n, d, d};
    first.level = second.level = piece.level + 1;
    return {first, second};
}

/// Returns the halves of a triangle whose height is next to nothing; nothing for any other. `cut`: the longest edge.
/// Cut at the middle of that edge again and again, such a triangle would become ever more needles upon one another. So
/// it is first cut at the foot of its height, and then a half is a strip between two edges, cut across.
std::optional<std::pair<Piece, Piece>> halves_of_needle(const Piece& piece, int cut) {
    constexpr double needle = 1e-4, rounding = 1e-15;
    const auto& [a, b, c] = piece.corners;
    const Vec3 &p = cut == 0 ? a : cut == 1 ? b : c, &q = cut == 0 ? b : cut == 1 ? c : a;
    const Vec3& r = cut == 0 ? c : cut == 1 ? a : b;
    const Vec3 along = q - p, aside = r - p;
    const double squared_length = squared_norm(along), length = std::sqrt(squared_length);
    const double height = squared_length > 0 ? norm(cross(along, aside)) / length : 0;
    if (!(height <= needle * length)) {
        return std::nullopt;
    }
    const double share = squared_length > 0 ? std::clamp(dot(aside, along) / squared_length, 0.0, 1.0) : 0;
    const double far = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (std::min(share, 1 - share) * length > 4 * height + rounding * (length + far)) {
        const double of_p = 1 - share, of_q = 1 - of_p; // add up to exactly 1
        const Vec3 foot = p * of_p + q * of_q;
        Piece first = piece, second = piece;
        first.corners = {p, foot, r};
        second.corners = {foot, q, r};
        first.level = second.level = piece.level + 2;
        return std::pair{first, second};
    }
    return share < 0.5 ? halves_of_strip(piece, q, p, q, r) : halves_of_strip(piece, p, q, p, r);
}

} // namespace

PiecePoints::PiecePoints(const Piece& piece)
    : points{piece.corners.a, piece.corners.b, piece.corners.c, piece.beneath.a, piece.beneath.b, piece.beneath.c},
      count(piece.curved ? 6 : 3) {}

double reach(const Vec3& center, const Piece& piece) {
    const double top = squared_reach(center, piece.corners);
    return std::sqrt(piece.curved ? std::max(top, squared_reach(center, piece.beneath)) : top);
}

PieceMiddle middle_of(const Piece& piece) {
    const Corners& t = piece.corners;
    const Vec3 point = (t.a + t.b + t.c) / 3;
    return {point, reach(point, piece)};
}

double size_of(const Piece& piece) {
    return std::sqrt(std::max(squared_edge(piece.corners), squared_height(piece)));
}

double diameter_of(const Piece& piece) {
    return std::sqrt(squared_edge(piece.corners)) + std::sqrt(squared_height(piece));
}

std::pair<Piece, Piece> halves(const Piece& piece) {
    const auto& [a, b, c] = piece.corners;
    const double ab = squared_norm(b - a), bc = squared_norm(c - b), ca = squared_norm(a - c);
    Piece first = piece, second = piece;
    ++first.level;
    ++second.level;
    if (squared_height(piece) > std::max({ab, bc, ca})) {
        const Corners& base = piece.beneath;
        first.beneath = second.corners = {(a + base.a) * 0.5, (b + base.b) * 0.5, (c + base.c) * 0.5};
        return {first, second};
    }
    if (is_strip(piece)) {
        return halves_of_strip(piece, a, b, piece.beneath.a, piece.beneath.b);
    }
    const int cut = ab >= bc && ab >= ca ? 0 : bc >= ca ? 1 : 2;
    if (!piece.curved) {
        if (const auto both = halves_of_needle(piece, cut)) {
            return *both;
        }
    }
    halve(first.corners, second.corners, cut);
    halve(first.beneath, second.beneath, cut);
    return {first, second};
}

Balls::Balls(const Solid& solid, std::span<const Sphere> spheres, std::uint32_t most_halvings, double caution)
    : origin_(solid.bounds().center()), extent_(0),
      unit_(std::numeric_limits<double>::epsilon() * (most_halvings + 8) * caution),
      placement_(8 * std::numeric_limits<double>::epsilon() * norm(origin_) * caution),
      triangles_(&solid.surface().triangles), vertices_(&solid.surface().vertices), runs_(&surface_runs(solid)) {
    extent_ = runs_->extent();
    std::vector<Box> boxes(spheres.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Vec3 center = spheres[i].center - origin_;
        centers_.push_back(is_finite(center) ? center : Vec3{});
        given_centers_.push_back(spheres[i].center);
        full_radii_.push_back(spheres[i].radius);
        radii_.push_back(is_finite(center) ? shrunk(static_cast<std::uint32_t>(i), spheres[i].radius) : -infinity);
        boxes[i].add(centers_[i]);
    }
    bvh_ = Bvh(boxes, 8);
    update_largest();
    find_round_parts(solid);
}

void Balls::find_round_parts(const Solid& solid) {
    CancellationCounter asking(256);
    for (std::size_t i = 0; i < solid.parts().size(); ++i) {
        asking.check();
        const Solid::Part& part = solid.parts()[i];
        if (!part.primitive || !kind_of(*part.primitive).has_known_surface()) {
            continue;
        }
        find_beneath(solid, i);
        if (part.primitive->kind != Element::Kind::sphere && part.primitive->kind != Element::Kind::capsule) {
            continue;
        }
        const double half = part.primitive->half.z;
        const Vec3 center = part.pose.translation, along = part.pose.rotate({0, 0, half});
        round_parts_.push_back({solid.part_offsets()[i], solid.part_offsets()[i + 1], center - origin_ - along,
                                center - origin_ + along, center, part.primitive->radius});
    }
}

/// Returns how far a ball about the origin lies straight below a point, against a unit normal; 0 if the point is in it.
static double depth_of_ball(const Vec3& point, const Vec3& normal, double radius) {
    const double height = dot(point, normal), squared_aside = squared_norm(point) - height * height;
    return std::max(0.0, height - std::sqrt(std::max(0.0, radius * radius - squared_aside)));
}

/// Computes the surface beneath the polyhedron. Every point of the true surface lies straight below some point of a
/// facet, since each facet touches the ball, or the cylinder's side, in one point. Its depth is a convex function over
/// the facet (the primitive is convex), so it is nowhere greater than the interpolated depths below the corners. Below
/// a corner the depth is measured to the ball about the nearest point of the axis, which is in the primitive and so no
/// higher than its surface. The flat ends of a cylinder lie in those of the polyhedron. An ellipsoid and its polyhedron
/// are the image of a ball with its own; the depth is measured there, and "below" is the image of that direction.
void Balls::find_beneath(const Solid& solid, std::size_t index) {
    const Solid::Part& part = solid.parts()[index];
    const Element& primitive = *part.primitive;
    const bool cylinder = primitive.kind == Element::Kind::cylinder,
               ellipsoid = primitive.kind == Element::Kind::ellipsoid;
    const Vec3 scale = ellipsoid ? primitive.half : Vec3{1, 1, 1};
    const double radius = ellipsoid ? 1 : primitive.radius, half = ellipsoid ? 0 : primitive.half.z;
    const Vec3 center = part.pose.translation - origin_, along = part.pose.rotate({0, 0, 1});
    const Pose to_own = part.pose.inverse();
    const auto to_ball = [&](const Vec3& v) {
        const Vec3 q = to_own.rotate(v);
        return Vec3{q.x / scale.x, q.y / scale.y, q.z / scale.z};
    };
    beneath_.resize(triangles_->size());
    curved_.resize(triangles_->size(), 0);
    for (std::uint32_t i = solid.part_offsets()[index]; i < solid.part_offsets()[index + 1]; ++i) {
        const Corners t = piece(i).corners;
        const Vec3 ab = t.b - t.a, ac = t.c - t.a;
        const Vec3 normal = ellipsoid ? normalized(cross(to_ball(ab), to_ball(ac))) : normalized(cross(ab, ac));
        if (cylinder && std::abs(dot(normal, along)) > 0.5) {
            continue;
        }
        const auto below = [&](const Vec3& corner) {
            if (ellipsoid) {
                const Vec3 down = normal * depth_of_ball(to_ball(corner - center), normal, radius);
                return corner - part.pose.rotate({down.x * scale.x, down.y * scale.y, down.z * scale.z});
            }
            const Vec3 axis = center + std::clamp(dot(corner - center, along), -half, half) * along;
            return corner - depth_of_ball(corner - axis, normal, radius) * normal;
        };
        curved_[i] = 1;
        beneath_[i] = {below(t.a), below(t.b), below(t.c)};
    }
}

double Balls::radius_around(std::uint32_t i, const RoundPart& part) const {
    if (part.from == part.to && given_centers_[i] == part.center) {
        return part.radius;
    }
    const double away = std::max(distance(centers_[i], part.from), distance(centers_[i], part.to));
    return full_radius(i, away + part.radius);
}

bool Balls::held(const RoundPart& part) const {
    for (std::uint32_t i = 0; i < size(); ++i) {
        if (std::isfinite(radii_[i]) && full_radii_[i] >= radius_around(i, part)) {
            return true;
        }
    }
    return false;
}

void Balls::update_largest() {
    largest_.assign(bvh_.nodes().size(), 0);
    for (std::size_t n = bvh_.nodes().size(); n-- > 0;) {
        const BvhNode& node = bvh_.nodes()[n];
        largest_[n] = node.leaf() ? -infinity : std::max(largest_[node.first], largest_[node.first + 1]);
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            largest_[n] = std::max(largest_[n], radii_[bvh_.order()[k]]);
        }
    }
}

double Balls::slack(double center_norm, double radius) const {
    return unit_ * (extent_ + center_norm + radius) + placement_;
}

double Balls::full_radius(std::uint32_t i, double wanted) const {
    const double c = norm(centers_[i]);
    return std::max(wanted + 2 * slack(c, 2 * wanted), 2 * smallest_ball);
}

double Balls::shrunk(std::uint32_t i, double full_radius) const {
    return std::isfinite(full_radius) ? full_radius - slack(norm(centers_[i]), std::abs(full_radius)) : -infinity;
}

void Balls::set_radius(std::uint32_t i, double full_radius) {
    full_radii_[i] = full_radius;
    radii_[i] = shrunk(i, full_radius);
    update_largest();
}

double Balls::limit(std::uint32_t i) const {
    const bool sound = radii_[i] >= smallest_ball && radii_[i] <= largest_ball;
    return sound ? radii_[i] * radii_[i] : -1;
}

bool Balls::holds(std::uint32_t i, const Corners& t) const {
    const double most = limit(i);
    return squared_norm(t.a - centers_[i]) <= most && squared_norm(t.b - centers_[i]) <= most &&
           squared_norm(t.c - centers_[i]) <= most;
}

bool Balls::holds(std::uint32_t i, const Piece& piece) const {
    return holds(i, piece.corners) && (!piece.curved || holds(i, piece.beneath));
}

Piece Balls::piece(std::uint32_t i) const {
    Piece piece{.corners = corners(i), .beneath = {}, .triangle = i};
    if (!curved_.empty() && curved_[i]) {
        piece.curved = true;
        piece.beneath = beneath_[i];
    }
    return piece;
}

template <class Take> void Balls::visit_near(const Vec3& p, const double& limit, Take take) const {
    struct Waiting {
        double least_gap;
        std::uint32_t node;
    };
    const auto least_gap = [&](std::uint32_t n) {
        return std::sqrt(squared_distance(bvh_.nodes()[n], p)) - largest_[n];
    };
    std::array<Waiting, Bvh::max_depth> stack;
    std::size_t size = 0;
    stack[size++] = {least_gap(0), 0};
    while (size > 0) {
        const Waiting next = stack[--size];
        if (!(next.least_gap <= limit)) {
            continue;
        }
        const BvhNode& node = bvh_.nodes()[next.node];
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            take(bvh_.order()[k]);
        }
        if (!node.leaf()) {
            Waiting near{least_gap(node.first), node.first}, far{least_gap(node.first + 1), node.first + 1};
            if (!(near.least_gap <= far.least_gap)) {
                std::swap(near, far);
            }
            stack[size++] = far;
            stack[size++] = near;
        }
    }
}

std::uint32_t Balls::nearest_to(const Vec3& p) const {
    double nearest_gap = infinity;
    auto nearest = static_cast<std::uint32_t>(size());
    if (bvh_.nodes().empty()) {
        return nearest;
    }
    visit_near(p, nearest_gap, [&](std::uint32_t i) {
        const double g = gap(i, p);
        if (g < nearest_gap || (g == nearest_gap && i < nearest)) {
            nearest_gap = g;
            nearest = i;
        }
    });
    return nearest;
}

bool Balls::any_holds(const SurfaceRuns::Run& run, std::uint32_t& last, std::vector<std::uint32_t>& near) const {
    near.clear();
    if (bvh_.nodes().empty()) {
        return false;
    }
    if (holds(last, run)) {
        return true;
    }
    bool whole = false;
    const double limit = run.radius; // a ball that comes less near contains no corner
    visit_near(run.center, limit, [&](std::uint32_t i) {
        if (!whole && gap(i, run.center) <= limit) {
            near.push_back(i);
            whole = holds(i, run);
            last = whole ? i : last;
        }
    });
    return whole;
}

std::vector<std::uint32_t> Balls::open_triangles() const {
    std::vector<std::uint32_t> open;
    std::uint32_t last = 0; // ball that contained the run before
    std::vector<std::uint32_t> near;
    CancellationCounter asking(64);
    for (std::size_t g = 0; g < runs_->group_count(); ++g) {
        asking.check();
        if (std::isfinite(runs_->group(g).radius) && any_holds(runs_->group(g), last, near)) {
            continue;
        }
        const std::size_t first = g * SurfaceRuns::group_length;
        for (std::size_t r = first; r < std::min(first + SurfaceRuns::group_length, runs_->size()); ++r) {
            const SurfaceRuns::Run& run = (*runs_)[r];
            const bool flat = std::isfinite(run.radius);
            if (flat && any_holds(run, last, near)) {
                continue;
            }
            for (const std::uint32_t t : runs_->triangles(r)) {
                const auto contains = [&](std::uint32_t i) { return holds(i, corners(t)); };
                if (!flat || std::none_of(near.begin(), near.end(), contains)) {
                    open.push_back(t);
                }
            }
        }
    }
    std::sort(open.begin(), open.end());
    return open;
}

double Balls::candidates(const Piece& piece, std::vector<std::uint32_t>& result) const {
    const PieceMiddle middle = middle_of(piece);
    const std::uint32_t nearest = nearest_to(middle.point);
    if (nearest == size() || gap(nearest, middle.point) == infinity) {
        return infinity;
    }
    result.push_back(nearest);
    const double limit = gap(nearest, middle.point) + 2.001 * middle.radius + unit_ * extent_;
    if (holds(nearest, piece)) {
        return limit;
    }
    visit_near(middle.point, limit, [&](std::uint32_t i) {
        if (i != nearest && gap(i, middle.point) <= limit) {
            result.push_back(i);
        }
    });
    return limit;
}

double Balls::candidates(const Piece& piece, std::size_t begin, std::size_t end,
                         std::vector<std::uint32_t>& result) const {
    const PieceMiddle middle = middle_of(piece);
    double nearest_gap = infinity;
    std::size_t nearest = begin;
    for (std::size_t k = begin; k < end; ++k) {
        const double g = gap(result[k], middle.point);
        if (g < nearest_gap) {
            nearest_gap = g;
            nearest = k;
        }
    }
    const std::uint32_t first = result[nearest];
    const double limit = nearest_gap + 2.001 * middle.radius + unit_ * extent_;
    result.push_back(first);
    for (std::size_t k = begin; k < end; ++k) {
        if (k != nearest && gap(result[k], middle.point) <= limit) {
            result.push_back(result[k]);
        }
    }
    return limit;
}

} // namespace foam::geometry
