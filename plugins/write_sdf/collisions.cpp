#include "collisions.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

namespace foam::sdf {

std::string vector_text(const Vec3& v) {
    return number_text(v.x) + ' ' + number_text(v.y) + ' ' + number_text(v.z);
}

std::string pose_text(const Pose& pose, const std::string& relative_to) {
    const std::string frame = relative_to.empty() ? "" : " relative_to=\"" + markup_escaped(relative_to) + "\"";
    return fmt::format("<pose{}>{} {}</pose>", frame, vector_text(pose.translation),
                       vector_text(short_roll_pitch_yaw(pose)));
}

namespace {

/// Returns the <geometry> of an element that is no sphere; `hull`: the reference to the mesh of a hull.
std::string geometry_text(const Element& element, const std::string& hull) {
    switch (element.kind) {
    case Element::Kind::box:
        return "<box><size>" + vector_text(element.half * 2) + "</size></box>";
    case Element::Kind::hull:
        return "<mesh><uri>" + markup_escaped(hull) + "</uri></mesh>";
    case Element::Kind::ellipsoid:
        return "<ellipsoid><radii>" + vector_text(element.half) + "</radii></ellipsoid>";
    case Element::Kind::sphere:
    case Element::Kind::swept_box: // in_known_kinds() leaves none
    case Element::Kind::capsule:
    case Element::Kind::cylinder:
        break;
    }
    // SDF's length, too, is without caps.
    return fmt::format("<{0}><radius>{1}</radius><length>{2}</length></{0}>", to_string(element.kind),
                       number_text(element.radius), number_text(2 * element.half.z));
}

CollisionText collision_of(std::size_t index, const Vec3& place, const Vec3& rpy, std::string_view kind,
                           const std::string& shape) {
    return {.name = fmt::format("{}_{}", kind, index),
            .pose = "<pose>" + vector_text(place) + " " + vector_text(rpy) + "</pose>",
            .geometry = "<geometry>" + shape + "</geometry>"};
}

CollisionText collision_of(std::size_t index, const Element& element, const std::string& hull) {
    Vec3 rpy;
    Element stated = element;
    if (element.kind != Element::Kind::hull) { // which has no rotation: float32_hull()
        rpy = short_roll_pitch_yaw(element.pose);
        stated = stated_at(element, Pose::from_xyz_rpy(element.pose.translation, rpy));
    }
    return collision_of(index, element.pose.translation, rpy, to_string(element.kind), geometry_text(stated, hull));
}

} // namespace

std::string shape_text(const Element& primitive) {
    return primitive.kind == Element::Kind::sphere
               ? "<sphere><radius>" + number_text(primitive.radius) + "</radius></sphere>"
               : geometry_text(primitive, "");
}

std::vector<CollisionText> collisions_of(const LinkSpheres& link, HullNames& hulls) {
    std::vector<CollisionText> collisions;
    CancellationCounter asking(1024);
    for (const Sphere& sphere : link.elements.spheres()) {
        asking.check();
        collisions.push_back(collision_of(collisions.size(), sphere.center, {}, "sphere",
                                          "<sphere><radius>" + number_text(sphere.radius) + "</radius></sphere>"));
    }
    for (const Element& element : link.elements.shaped()) {
        asking.check();
        const std::string hull = element.kind == Element::Kind::hull ? hulls.next(link.link) : "";
        collisions.push_back(collision_of(collisions.size(), element, hull));
    }
    return collisions;
}

} // namespace foam::sdf
