// Inside queries of solids along lines.
#include "solid/solid_data.hpp"

namespace foam::inline geometry {
void winding_along(const PartQueries& part, const Line& line, std::span<const Crossing> crossings,
                   std::vector<WindingPiece>& pieces) {
    if (part.primitive) {
        if (const auto interval = part.primitive->inside_along(line.origin(), line.direction())) {
            pieces.push_back({interval->enter, interval->leave, 1});
        }
        return;
    }
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        winding += crossings[i].change;
        if (winding != 0 && crossings[i].t < crossings[i + 1].t) {
            pieces.push_back({crossings[i].t, crossings[i + 1].t, winding});
        }
    }
}

void add_inside_along(const PartQueries& part, const Line& line, std::span<const Crossing> crossings,
                      std::span<const Solid::Interval> within, std::vector<WindingPiece>& pieces, Intervals& result) {
    if (!part.closed()) {
        part.mesh().inside_along(line.origin(), line.direction(), crossings, within, result);
        return;
    }
    pieces.clear();
    winding_along(part, line, crossings, pieces);
    for (const WindingPiece& piece : pieces) {
        if (piece.winding > 0) {
            result.push_back({piece.enter, piece.leave});
        }
    }
}

Intervals SolidData::inside_along(const Line& line, std::span<const Solid::Interval> within) const {
    Intervals result;
    std::vector<Crossing> crossings;
    std::vector<WindingPiece> pieces;
    for_each_along(line, [&](const PartQueries& part) {
        if (!part.primitive) {
            part.mesh().crossings(line.origin(), line.direction(), crossings);
        }
        add_inside_along(part, line, crossings, within, pieces, result);
    });
    unite(result);
    return common(result, within);
}

std::vector<Solid::Interval> Solid::inside_along(const Vec3& origin, const Vec3& direction) const {
    return inside_along(origin, direction, geometry::whole_line);
}

std::vector<Solid::Interval> Solid::inside_along(const Vec3& origin, const Vec3& direction,
                                                 std::span<const Interval> parts) const {
    if (parts.empty() || !is_finite(origin) || !is_finite(direction) || direction == Vec3{}) {
        return {};
    }
    return data_->inside_along(geometry::Line(origin, direction), parts);
}

} // namespace foam::geometry
