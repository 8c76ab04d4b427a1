#include "mesh/mesh_part.hpp"

#include "mesh/orientation.hpp"

#include <foam/base/cancellation.hpp>

namespace foam::inline geometry {
namespace {

/// Largest ratio of closing triangles to those that count. Above it the surface itself is queried for winding numbers.
constexpr double most_closing = 0.5;
constexpr std::uint32_t leaf_size_of_many = 16;

} // namespace

MeshPart::MeshPart(const Mesh& mesh, const Reading& reading)
    : MeshPart(mesh, reading, mesh.triangles.size() > many ? Triangles::referred_to : Triangles::copied) {
    if (closed_) {
        return;
    }
    const Mesh closing = closing_surface(mesh, reading);
    const Reading closing_reading{std::vector(closing.triangles.size(), Facing::as_given), false};
    closing_.reset(new MeshPart(closing, closing_reading, Triangles::copied));
    const auto counting =
        reading.facing.size() -
        static_cast<std::size_t>(std::count(reading.facing.begin(), reading.facing.end(), Facing::ignored));
    quick_closing_ = static_cast<double>(closing.triangles.size()) <= most_closing * static_cast<double>(counting);
    const Vec3 center = box_.center();
    for (const auto& [a, b, c] : closing.triangles) {
        const std::vector<Vec3>& v = closing.vertices;
        signed_volume_ += dot(v[a] - center, cross(v[b] - center, v[c] - center)) / 6;
    }
}

MeshPart::MeshPart(const Mesh& mesh, const Reading& reading, Triangles triangles) : closed_(reading.closed) {
    const std::size_t count = mesh.triangles.size();
    std::vector<Box> boxes(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::uint32_t corner : mesh.triangles[i]) {
            boxes[i].add(mesh.vertices[corner]);
        }
        box_.add(boxes[i]);
    }
    const Vec3 center = box_.center();
    if (triangles == Triangles::referred_to) {
        bvh_ = Bvh::quick(boxes, leaf_size_of_many);
        mesh_ = &mesh;
        facing_ = reading.facing;
    } else {
        bvh_ = Bvh(boxes);
        copy_triangles(mesh, reading);
    }
    for_each_closed(
        [&](const Corners& t) { signed_volume_ += dot(t.a - center, cross(t.b - center, t.c - center)) / 6; });
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        largest = std::max({largest, std::abs(box_.low[axis]), std::abs(box_.high[axis])});
    }
    tolerance_ = 8 * std::numeric_limits<double>::epsilon() * largest;
    if (NeedleIndex::pays(boxes, box_)) {
        std::vector<Corners> needles;
        Corners scratch;
        for (std::uint32_t k = 0; k < count; ++k) {
            needles.push_back(corners(k, scratch));
        }
        needles_.emplace(needles, center);
    }
}

void MeshPart::copy_triangles(const Mesh& mesh, const Reading& reading) {
    items_.reserve(mesh.triangles.size());
    CancellationCounter asking(4096);
    for (const std::uint32_t i : bvh_.order()) {
        asking.check();
        const auto& [a, b, c] = mesh.triangles[i];
        Item item{{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, i, reading.facing[i] != Facing::ignored};
        if (reading.facing[i] == Facing::flipped) {
            std::swap(item.corners.b, item.corners.c);
        }
        items_.push_back(item);
    }
}

void MeshPart::closest(const Vec3& p, Nearest& nearest) const {
    Corners scratch;
    const auto look_at = [&](std::uint32_t k) {
        const Vec3 q = closest_on_triangle(corners(k, scratch), p);
        const double d2 = squared_norm(q - p);
        if (d2 < nearest.squared_distance) {
            nearest = {d2, q, bvh_.order()[k]};
        }
    };
    if (needles_) {
        needles_->for_each_nearer(p, [&] { return std::sqrt(nearest.squared_distance); }, look_at);
    } else {
        for_each_nearer(bvh_, p, [&] { return nearest.squared_distance; }, look_at);
    }
}

bool MeshPart::touches(const Vec3& p, double distance) const {
    Nearest nearest{std::nextafter(distance * distance, std::numeric_limits<double>::infinity())};
    const double limit = nearest.squared_distance;
    closest(p, nearest);
    return nearest.squared_distance < limit;
}

bool MeshPart::contains(const Vec3& p) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(box_.low[axis] - tolerance_ <= p[axis] && p[axis] <= box_.high[axis] + tolerance_)) {
            return false;
        }
    }
    return winding(p) > 0.5 || touches(p, tolerance_);
}

double MeshPart::winding(const Vec3& p) const {
    if (closed_ || quick_closing_) {
        int whole = 0;
        bool found = false;
        for (int axis = 0; axis < 3 && !found; ++axis) {
            found = winding_by_line(p, axis, whole);
        }
        if (found && closed_) {
            return whole;
        }
        if (found) {
            // On the closing surface, the line and its winding number may disagree on the side of the point.
            const Winding closing = closing_->winding_by_expansion(p);
            if (!closing.on_triangle) {
                return whole - closing.value;
            }
        }
    }
    return winding_by_expansion(p).value;
}

template <class Visit> void MeshPart::visit_line(const Line& line, Visit visit) const {
    Corners scratch;
    const auto cross_triangle = [&](std::uint32_t k) {
        double t = 0;
        if (counts(k)) {
            if (const int change = line.cross(corners(k, scratch), t); change != 0) {
                visit(t, change);
            }
        }
    };
    if (needles_) {
        needles_->for_each_along(line, cross_triangle);
        return;
    }
    // Boxes are slightly enlarged in tests, so that rounding never hides a triangle.
    const double margin = tolerance_ + 1e-12 * (box_.diagonal() + norm(line.origin() - box_.center()));
    const Vec3 o = line.origin(), d = line.direction();
    const int u = (line.axis() + 1) % 3, v = (line.axis() + 2) % 3;
    const bool aligned = line.axis_aligned();
    const auto hit = [&](const BvhNode& node) {
        if (aligned) {
            return node.low[u] - margin <= o[u] && o[u] <= node.high[u] + margin && node.low[v] - margin <= o[v] &&
                   o[v] <= node.high[v] + margin;
        }
        // Separating axes between a line and a box: the three cross products of the direction with the edges.
        const Vec3 half = (node.high - node.low) * 0.5 + Vec3{margin, margin, margin};
        const Vec3 c = cross(d, (node.low + node.high) * 0.5 - o);
        const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
        return std::abs(c.x) <= ay * half.z + az * half.y && std::abs(c.y) <= az * half.x + ax * half.z &&
               std::abs(c.z) <= ax * half.y + ay * half.x;
    };
    for_each_entered(bvh_, hit, cross_triangle);
}

bool MeshPart::winding_by_line(const Vec3& p, int axis, int& winding) const {
    Vec3 direction{};
    direction[axis] = 1;
    int before = 0, total = 0;
    const Line line(p, direction);
    const auto add = [&](double t, int change) {
        before += t <= 0 ? change : 0;
        total += change;
    };
    visit_line(line, add);
    if (closing_) {
        closing_->visit_line(line, add);
    }
    winding = before;
    return total == 0;
}

void MeshPart::crossings(const Vec3& origin, const Vec3& direction, std::vector<Crossing>& result) const {
    // Ties are broken consistently, so the changes sum to zero; they may not if rounding hits several edges at once. A
    // slightly shifted line then gives the same within rounding.
    const double step = 1e-11 * box_.diagonal() + tolerance_;
    Vec3 shifted = origin;
    for (int attempt = 0; attempt < 8; ++attempt) {
        result.clear();
        int total = 0;
        const Line line(shifted, direction);
        const auto add = [&](double t, int change) {
            result.push_back({t, change});
            total += change;
        };
        visit_line(line, add);
        if (closing_) {
            closing_->visit_line(line, add);
        }
        if (total == 0) {
            break;
        }
        const double turn = 2.39996322972865332 * attempt; // the golden angle: a new direction every time
        shifted = origin + step * (attempt + 1) * Vec3{std::cos(turn), std::sin(turn), std::cos(2 * turn + 1)};
    }
    std::sort(result.begin(), result.end());
}

} // namespace foam::geometry
