// Coverage and protrusion of convex elements.
#include "convex/element_surface.hpp"
#include "measure/element_set.hpp"
#include "measure/exposure.hpp"
#include "measure/farthest_exposed.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>

namespace foam::inline geometry {
namespace {

/// The other elements around one of a set.
class OthersAround {
public:
    OthersAround(const ElementSet& set, std::size_t i) : set_(set), i_(i), step_(1e-7 * set.box(i).diagonal()) {
        const Vec3 room = Vec3{1, 1, 1} * (2 * step_);
        for (std::uint32_t k = 0; k < set.size(); ++k) {
            const Box &a = set.box(i), &b = set.box(k);
            const Vec3 low = a.low - room, high = a.high + room;
            if (k != i && low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
                low.z <= b.high.z && b.low.z <= high.z) {
                near_.push_back(k);
            }
        }
    }

    std::vector<Element> elements() const {
        std::vector<Element> result;
        for (const std::uint32_t k : near_) {
            result.push_back(set_[k]);
        }
        return result;
    }
    /// Returns whether the point is on the surface of the union: no element is just beyond it. Where two elements have
    /// a part of their surface in common, it is that of the first.
    bool exposed(const Vec3& p, const Vec3& normal) const {
        const Vec3 out = p + normal * step_;
        for (const std::uint32_t k : near_) {
            if (holds(set_[k], out) || (k < i_ && holds(set_[k], p))) {
                return false;
            }
        }
        return true;
    }

private:
    const ElementSet& set_;
    std::size_t i_;
    double step_;
    std::vector<std::uint32_t> near_;
};

/// Returns the largest distance found by steps: the element's farthest point in the direction from the nearest point of
/// the solid comes next. Steps are kept while they lead to exposed points farther away.
double farther(const Solid& solid, const Element& element, const OthersAround& near, Vec3 p, double distance) {
    for (int k = 0; k < 8; ++k) {
        const Vec3 away = normalized(p - solid.closest(p).point);
        const Vec3 q = support(element, away);
        const double there = away == Vec3{} || !near.exposed(q, away) ? 0 : solid.signed_distance(q);
        if (!(there > distance)) {
            break;
        }
        distance = there;
        p = q;
    }
    return distance;
}

ExposedSums exposed_of(const Solid& solid, const ElementSet& set, std::size_t i, std::size_t samples) {
    constexpr std::size_t starts = 4; // of the search for the farthest point
    ExposedSums sums;
    const OthersAround near(set, i);
    std::vector<std::pair<double, Vec3>> best;
    CancellationCounter asking(64);
    for (const ElementPoint& at : surface_points(set[i], samples)) {
        asking.check();
        if (!near.exposed(at.point, at.normal)) {
            continue;
        }
        const double distance = solid.signed_distance(at.point);
        if (distance > 0) {
            sums.area += at.area;
            sums.weighted += at.area * distance;
            best.push_back({distance, at.point});
        }
    }
    const std::size_t count = std::min(starts, best.size());
    std::partial_sort(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(count), best.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t k = 0; k < count; ++k) {
        sums.farthest = std::max(sums.farthest, farther(solid, set[i], near, best[k].second, best[k].first));
    }
    return sums;
}

} // namespace

double covered_share(const Solid& solid, const ElementSet& set, const MeasureOptions& options) {
    const std::vector<SurfacePoint> points = solid.sample_surface(options.surface_points, options.seed);
    std::size_t covered = 0;
    CancellationCounter asking(1024);
    for (const SurfacePoint& sample : points) {
        asking.check();
        covered += set.hold(sample.point);
    }
    return points.empty() ? 0 : static_cast<double>(covered) / static_cast<double>(points.size());
}

Protrusion protrusion(const Solid& solid, const ElementSet& set, std::size_t samples) {
    std::vector<ExposedSums> parts(set.size());
    parallel_for(set.size(), [&](std::size_t i) { parts[i] = exposed_of(solid, set, i, samples); });
    double known = 0;
    for (const ExposedSums& part : parts) {
        known = std::max(known, part.farthest);
    }
    parallel_for(set.size(), [&](std::size_t i) {
        const OthersAround near(set, i);
        const double found = farthest_exposed(solid, set[i], near.elements(), known,
                                              [&](const Vec3& p, const Vec3& normal) { return near.exposed(p, normal); });
        parts[i].farthest = std::max(parts[i].farthest, found);
    });
    return protrusion_of(parts);
}

} // namespace foam::geometry
