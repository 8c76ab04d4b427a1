#include "object.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

namespace foam::sdf {
namespace {

/// Throws for a name that sdformat takes for another or refuses. `what`: "link" or "model".
void require_name(const std::string& name, std::string_view what) {
    const bool reserved = name == "world" || (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
    if (name.empty() || reserved || name.find("::") != name.npos || shown(name) != name) {
        throw Error(ErrorCode::output,
                    fmt::format("{} '{}': SDF holds no name that is empty, 'world' or '__…__', or has '::' or control "
                                "characters; remedy: another name",
                                what, shown(name)));
    }
}

std::string comment(std::string_view provenance) {
    std::string text = shown(provenance);
    for (std::size_t at = 0; (at = text.find("--", at)) != text.npos;) {
        text.replace(at, 2, "- -"); // "--" may not stand in a comment
    }
    return text.empty() ? "" : "<!-- " + text + " -->\n";
}

std::string collision_text(std::size_t index, const Sphere& s) {
    return fmt::format("      <collision name=\"sphere_{}\">\n"
                       "        <pose>{} {} {} 0 0 0</pose>\n"
                       "        <geometry><sphere><radius>{}</radius></sphere></geometry>\n"
                       "      </collision>\n",
                       index, number_text(s.center.x), number_text(s.center.y), number_text(s.center.z),
                       number_text(s.radius));
}

std::string vector_text(const Vec3& v) {
    return number_text(v.x) + ' ' + number_text(v.y) + ' ' + number_text(v.z);
}

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

std::string collision_text(std::size_t index, const Element& element, const std::string& hull) {
    Vec3 rpy;
    Element stated = element;
    if (element.kind != Element::Kind::hull) { // which has no rotation: float32_hull()
        rpy = short_roll_pitch_yaw(element.pose);
        stated = stated_at(element, Pose::from_xyz_rpy(element.pose.translation, rpy));
    }
    return fmt::format("      <collision name=\"{}_{}\">\n"
                       "        <pose>{} {}</pose>\n"
                       "        <geometry>{}</geometry>\n"
                       "      </collision>\n",
                       to_string(element.kind), index, vector_text(element.pose.translation), vector_text(rpy),
                       geometry_text(stated, hull));
}

} // namespace

std::string file_name_of(const SphereModel& model) {
    return model.file.empty() ? model.name + ".sdf" : model.file;
}

std::string object_text(const SphereModel& model, bool is_static, const KnownKinds& known) {
    const std::vector<LinkSpheres> links = in_known_kinds(elements_by_link(model), known);
    if (links.size() != 1) {
        throw Error(ErrorCode::output, fmt::format("write.sdf writes objects of one link, the model has {}; remedy: "
                                                   "write.urdf for a robot, Gazebo reads it",
                                                   links.size()));
    }
    const LinkSpheres& link = links.front();
    const std::string name = model.robot && !model.robot->name.empty() ? model.robot->name : model.name;
    require_name(name, "model");
    require_name(link.link, "link");
    std::string text = "<?xml version=\"1.0\"?>\n" + comment(model.provenance) +
                       fmt::format("<sdf version=\"1.9\">\n  <model name=\"{}\">\n    <static>{}</static>\n"
                                   "    <link name=\"{}\">\n",
                                   markup_escaped(name), is_static, markup_escaped(link.link));
    CancellationCounter asking(1024);
    std::size_t i = 0;
    for (const Sphere& sphere : link.elements.spheres()) {
        asking.check();
        text += collision_text(i++, sphere);
    }
    HullNames names(file_name_of(model));
    for (const Element& element : link.elements.shaped()) {
        asking.check();
        text += collision_text(i++, element, element.kind == Element::Kind::hull ? names.next(link.link) : "");
    }
    return text + "    </link>\n  </model>\n</sdf>\n";
}

} // namespace foam::sdf
