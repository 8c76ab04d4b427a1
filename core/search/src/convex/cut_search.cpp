#include "cut_search.hpp"

#include <foam/geometry/directions.hpp>

#include <algorithm>

namespace foam::inline search::convex {

CutSearch::CutSearch(std::vector<const Brick*> bricks, const PairPrice& price, PointsInPlane in_plane)
    : bricks_(std::move(bricks)), price_(price), in_plane_(std::move(in_plane)) {
    for (const Brick* brick : bricks_) {
        box_.add(brick->box);
    }
}

Cut CutSearch::at(const Plane& plane) {
    below_.clear();
    above_.clear();
    for (const Brick* brick : bricks_) {
        append_parts(*brick, plane, below_, above_);
    }
    if (below_.empty() || above_.empty()) {
        return {plane};
    }
    if (in_plane_) {
        both_.clear();
        in_plane_(plane, both_);
        below_.insert(below_.end(), both_.begin(), both_.end());
        above_.insert(above_.end(), both_.begin(), both_.end());
    }
    return {plane, price_(below_, above_)};
}

Cut CutSearch::start() {
    constexpr std::size_t directions = 18;
    Cut best;
    for (const Vec3& normal : fibonacci_directions(directions)) {
        if (normal.z < 0) {
            continue;
        }
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Brick* brick : bricks_) {
            for (const Vec3& p : brick->points) {
                low = std::min(low, dot(normal, p));
                high = std::max(high, dot(normal, p));
            }
        }
        for (const double share : {0.3, 0.5, 0.7}) {
            if (const Cut cut = at({normal, low + share * (high - low)}); cut.price < best.price) {
                best = cut;
            }
        }
    }
    return best;
}

Cut CutSearch::improved(Cut best, int tries) {
    constexpr double first_step = 0.08, last_step = 1e-3; // of the size, at the rim of the bricks
    const double reach = box_.diagonal() / 2;
    double step = first_step * box_.diagonal();
    while (tries > 0 && step > last_step * reach) {
        const Vec3 other = std::abs(best.plane.normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 x = normalized(cross(best.plane.normal, other)), y = cross(best.plane.normal, x);
        const Vec3 middle = box_.center() - best.plane.normal * best.plane.height(box_.center());
        Cut next = best;
        for (int k = 0; k < 6; ++k, --tries) {
            const double length = k % 2 == 0 ? step : -step;
            Plane plane = best.plane;
            if (k < 2) {
                plane.offset += length;
            } else {
                plane.normal = normalized(plane.normal + (k < 4 ? x : y) * (length / reach));
                plane.offset = dot(plane.normal, middle);
            }
            if (const Cut found = at(plane); found.price < next.price) {
                next = found;
            }
        }
        if (next.price < best.price * (1 - 1e-6)) {
            best = next;
        } else {
            step /= 2.5;
        }
    }
    return best;
}

} // namespace foam::inline search::convex
