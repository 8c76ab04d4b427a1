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
    part.mesh().crossings(origin, direction, scratch);
    int winding = 0;
    for (std::size_t i = 0; i + 1 < scratch.size(); ++i) {
        winding += scratch[i].change;
        if (winding != 0 && scratch[i].t < scratch[i + 1].t) {
            pieces.push_back({scratch[i].t, scratch[i + 1].t, winding});
        }
    }
}

Intervals SolidData::inside_along(const Vec3& origin, const Vec3& direction,
                                  std::span<const Solid::Interval> within) const {
    Intervals result;
    std::vector<Crossing> crossings;
    std::vector<WindingPiece> pieces;
    for (const PartQueries& part : queries) {
        if (!part.closed()) {
            part.mesh().crossings(origin, direction, crossings);
            part.mesh().inside_along(origin, direction, crossings, within, result);
            continue;
        }
        pieces.clear();
        winding_along(part, origin, direction, crossings, pieces);
        for (const WindingPiece& piece : pieces) {
            if (piece.winding > 0) {
                result.push_back({piece.enter, piece.leave});
            }
        }
    }
    unite(result);
    return common(result, within);
}

} // namespace geometry

std::vector<Solid::Interval> Solid::inside_along(const Vec3& origin, const Vec3& direction) const {
    return inside_along(origin, direction, geometry::whole_line);
}

std::vector<Solid::Interval> Solid::inside_along(const Vec3& origin, const Vec3& direction,
                                                 std::span<const Interval> parts) const {
    if (parts.empty() || !is_finite(origin) || !is_finite(direction) || direction == Vec3{}) {
        return {};
    }
    return data_->inside_along(origin, direction, parts);
}

} // namespace foam
