// Solids along lines.
#include "geometry/solid_data.hpp"

namespace foam {
namespace geometry {

void winding_along(const PartQueries& part, const Vec3& origin, const Vec3& direction, std::vector<Crossing>& scratch,
                   std::vector<WindingPiece>& pieces) {
    if (part.primitive) {
        if (const auto interval = part.primitive->inside_along(origin, direction)) {
            pieces.push_back({interval->enter, interval->leave, 1});
        }
        return;
    }
    part.mesh.crossings(origin, direction, scratch);
    int winding = 0;
    for (std::size_t i = 0; i + 1 < scratch.size(); ++i) {
        winding += scratch[i].change;
        if (winding != 0 && scratch[i].t < scratch[i + 1].t) {
            pieces.push_back({scratch[i].t, scratch[i + 1].t, winding});
        }
    }
}

double open_along(const MeshPart& mesh, const Vec3& origin, const Vec3& direction, std::vector<Crossing>& scratch,
                  std::vector<Solid::Interval>& intervals) {
    mesh.crossings(origin, direction, scratch);
    mesh.inside_along(origin, direction, scratch, intervals);
    double wound = 0;
    int winding = 0;
    for (std::size_t i = 0; i + 1 < scratch.size(); ++i) {
        winding += scratch[i].change;
        wound += winding * (scratch[i + 1].t - scratch[i].t);
    }
    return wound;
}

void unite(std::vector<Solid::Interval>& intervals) {
    std::sort(intervals.begin(), intervals.end(), [](const Solid::Interval& a, const Solid::Interval& b) {
        return a.enter != b.enter ? a.enter < b.enter : a.leave < b.leave;
    });
    std::size_t count = 0;
    for (const Solid::Interval& next : intervals) {
        if (count > 0 && next.enter <= intervals[count - 1].leave) {
            intervals[count - 1].leave = std::max(intervals[count - 1].leave, next.leave);
        } else {
            intervals[count++] = next;
        }
    }
    intervals.resize(count);
}

} // namespace geometry

std::vector<Solid::Interval> Solid::inside_along(const Vec3& origin, const Vec3& direction) const {
    if (!is_finite(origin) || !is_finite(direction) || direction == Vec3{}) {
        return {};
    }
    std::vector<Interval> result;
    std::vector<geometry::Crossing> scratch;
    std::vector<geometry::WindingPiece> pieces;
    for (const geometry::PartQueries& part : data_->queries) {
        if (!part.closed()) {
            geometry::open_along(part.mesh, origin, direction, scratch, result);
            continue;
        }
        pieces.clear();
        geometry::winding_along(part, origin, direction, scratch, pieces);
        for (const geometry::WindingPiece& piece : pieces) {
            if (piece.winding > 0) {
                result.push_back({piece.enter, piece.leave});
            }
        }
    }
    geometry::unite(result);
    return result;
}

} // namespace foam
