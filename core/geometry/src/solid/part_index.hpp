// A hierarchy over the parts of a solid, for queries.
#pragma once

#include "mesh/line_crossing.hpp"

#include <foam/geometry/internal/bvh.hpp>

#include <cmath>

namespace foam::inline geometry {

/// A hierarchy over the boxes of parts. Boxes count as slightly larger than they are, so that rounding hides no part.
class PartIndex {
public:
    /// The number of parts from which a solid uses the index; with fewer it visits each.
    static constexpr std::size_t many = 32;

    PartIndex() = default;
    PartIndex(std::span<const Box> boxes, const Box& all)
        : bvh_(boxes), center_(all.center()), margin_(1e-9 * all.diagonal()) {}

    bool empty() const { return bvh_.nodes().empty(); }
    double margin() const { return margin_; }

    /// Calls visit(part) for the parts whose boxes contain the point, until one call returns true. Returns whether one
    /// did.
    template <class Visit> bool any_at(const Vec3& p, Visit visit) const {
        bool found = false;
        traverse([&](const BvhNode& node) { return !found && squared_distance(node, p) <= margin_ * margin_; },
                 [&](std::uint32_t part) { found = found || visit(part); });
        return found;
    }

    /// Calls visit(part) for the parts that may be as near to the point as nearest(), m, the near ones first.
    template <class Least, class Visit> void for_each_nearer(const Vec3& p, Least nearest, Visit visit) const {
        const double margin = margin_ + 1e-12 * norm(p - center_);
        geometry::for_each_nearer(
            bvh_, p,
            [&] {
                const double reach = nearest() + margin;
                return reach > 0 ? reach * reach : 0.0;
            },
            [&](std::uint32_t k) { visit(bvh_.order()[k]); });
    }

    /// Calls visit(part) for the parts whose boxes the line meets.
    template <class Visit> void for_each_along(const Line& line, Visit visit) const {
        const Vec3 o = line.origin(), d = line.direction();
        const double margin = margin_ + 1e-12 * norm(o - center_);
        const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
        // Separating axes between a line and a box: the three cross products of the direction with the edges.
        const auto met = [&](const BvhNode& node) {
            const Vec3 half = (node.high - node.low) * 0.5 + Vec3{margin, margin, margin};
            const Vec3 c = cross(d, (node.low + node.high) * 0.5 - o);
            return std::abs(c.x) <= ay * half.z + az * half.y && std::abs(c.y) <= az * half.x + ax * half.z &&
                   std::abs(c.z) <= ax * half.y + ay * half.x;
        };
        traverse(met, visit);
    }

private:
    template <class Enters, class Visit> void traverse(Enters enters, Visit visit) const {
        for_each_entered(bvh_, enters, [&](std::uint32_t place) { visit(bvh_.order()[place]); });
    }

    Bvh bvh_;
    Vec3 center_;
    double margin_ = 0;
};

} // namespace foam::geometry
