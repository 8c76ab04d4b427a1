#include "pose.hpp"

#include "mesh_files.hpp"

namespace judge {

Point vector_of(const std::string& text, const Point& otherwise) {
    if (text.empty()) {
        return otherwise;
    }
    const std::vector<double> v = numbers_of(text);
    return {v.at(0), v.at(1), v.at(2)};
}

Placement placement_of(const Element& element) {
    Placement place;
    const Element* origin = element.child("origin");
    if (!origin) {
        return place;
    }
    place.offset = vector_of(origin->attribute("xyz"), {});
    const Point rpy = vector_of(origin->attribute("rpy"), {});
    place.turned = rpy.x != 0 || rpy.y != 0 || rpy.z != 0;
    const Real cr = std::cos(rpy.x), sr = std::sin(rpy.x), cp = std::cos(rpy.y), sp = std::sin(rpy.y),
               cy = std::cos(rpy.z), sy = std::sin(rpy.z);
    place.x = {cy * cp, sy * cp, -sp};
    place.y = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr};
    place.z = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr};
    return place;
}

/// Of |p| and the offset t, each coordinate, in unit roundoffs: an entry of the rotation is a sum of two products of
/// sines, each within 1: four; its product with a coordinate, and the sum of three: another three; so seven of
/// |x| + |y| + |z| <= sqrt(3) |p|, over three coordinates: 3 * 7 = 21 of |p|. A scale: one of |p|. The offset: one of
/// |p| + |t|. What is neither turned, scaled nor moved loses nothing.
Real placement_error(const Placement& place, bool scaled, Real size) {
    const bool moved = place.offset.x != 0 || place.offset.y != 0 || place.offset.z != 0;
    Real error = place.turned ? 21 * size : 0;
    error += scaled ? 2 * size : 0;
    error += moved ? 2 * (size + length(place.offset)) : 0;
    return unit_roundoff * error;
}

} // namespace judge
