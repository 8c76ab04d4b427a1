#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

namespace foam {
namespace {

using Kind = Element::Kind;

std::string collision_element(const Vec3& xyz, const Vec3& rpy, const std::string& shape, const UrdfWords& words) {
    return "<collision><origin xyz=\"" + three_numbers(xyz) + "\" rpy=\"" + three_numbers(rpy) + "\"/><geometry>" +
           shape + "</geometry>" + words.properties + "</collision>";
}

[[noreturn]] void unreadable(const xml::Element& element, const std::string& why) {
    throw Error(ErrorCode::output, fmt::format("URDF:{}: <{}> {}", element.line, element.name, why));
}

/// Returns the numbers of an attribute; `fallback` if it is absent.
std::vector<double> read_numbers(const xml::Element& element, std::string_view attribute, std::size_t count,
                                 std::string_view fallback) {
    const std::string* text = element.attribute(attribute);
    std::vector<double> numbers;
    for (const std::string_view word : words(text ? std::string_view(*text) : fallback)) {
        const std::optional<double> value = parse_number(word);
        if (!value) {
            unreadable(element, fmt::format("holds '{}', which is not a finite number", word));
        }
        numbers.push_back(*value);
    }
    if (numbers.size() != count) {
        unreadable(element, fmt::format("holds {} numbers in {}, not {}", numbers.size(), attribute, count));
    }
    return numbers;
}

Vec3 read_vector(const xml::Element& element, std::string_view attribute, std::string_view fallback) {
    const std::vector<double> numbers = read_numbers(element, attribute, 3, fallback);
    return {numbers[0], numbers[1], numbers[2]};
}

double read_number(const xml::Element& element, std::string_view attribute) {
    return read_numbers(element, attribute, 1, "").front();
}

/// Returns the hull of a mesh that is beside the file; nothing for another mesh.
std::optional<Element> read_hull(const xml::Element& mesh, const std::map<std::string, std::string>& beside) {
    const std::string* uri = mesh.attribute("filename");
    const std::string* text = uri ? text_beside(beside, *uri) : nullptr;
    try {
        return text ? std::optional(hull_of(*text)) : std::nullopt;
    } catch (const Error& error) {
        throw Error(ErrorCode::output, fmt::format("{}: {}", *uri, error.what()));
    }
}

std::optional<Element> read_shape(const xml::Element& shape, const std::map<std::string, std::string>& beside) {
    if (shape.name == "sphere") {
        return Element{.kind = Kind::sphere, .radius = read_number(shape, "radius")};
    }
    if (shape.name == "box") {
        return Element{.kind = Kind::box, .half = read_vector(shape, "size", "") * 0.5};
    }
    if (shape.name == "cylinder" || shape.name == "capsule" || shape.name == "drake:capsule") {
        return Element{.kind = shape.name == "cylinder" ? Kind::cylinder : Kind::capsule,
                       .half = {0, 0, read_number(shape, "length") / 2},
                       .radius = read_number(shape, "radius")};
    }
    if (shape.name == "drake:ellipsoid") {
        return Element{.kind = Kind::ellipsoid,
                       .half = {read_number(shape, "a"), read_number(shape, "b"), read_number(shape, "c")}};
    }
    return shape.name == "mesh" ? read_hull(shape, beside) : std::nullopt;
}

} // namespace

std::string three_numbers(const Vec3& v) {
    return number_text(v.x) + " " + number_text(v.y) + " " + number_text(v.z);
}

std::string shape_text(const Element& element, const UrdfWords& words) {
    if (element.kind == Kind::sphere) {
        return "<sphere radius=\"" + number_text(element.radius) + "\"/>";
    }
    if (element.kind == Kind::box) {
        return "<box size=\"" + three_numbers(element.half * 2) + "\"/>";
    }
    if (element.kind == Kind::ellipsoid) {
        return fmt::format("<drake:ellipsoid a=\"{}\" b=\"{}\" c=\"{}\"/>", number_text(element.half.x),
                           number_text(element.half.y), number_text(element.half.z));
    }
    const std::string length = number_text(2 * element.half.z);
    const bool capsule = element.kind == Kind::capsule;
    // Newton reads `height` (newton/_src/utils/import_urdf.py of 1.8), all others `length`.
    return fmt::format("<{} radius=\"{}\" length=\"{}\"{}/>", capsule ? words.capsule : "cylinder",
                       number_text(element.radius), length,
                       capsule && words.capsule == "capsule" ? fmt::format(" height=\"{}\"", length) : "");
}

std::vector<std::string> collision_elements(const LinkSpheres& link, const UrdfWords& words,
                                            const std::function<std::string()>& uri_of_hull) {
    std::vector<std::string> result;
    for (const Sphere& sphere : link.elements.spheres()) {
        result.push_back(
            collision_element(sphere.center, {}, "<sphere radius=\"" + number_text(sphere.radius) + "\"/>", words));
    }
    for (const Element& element : link.elements.shaped()) {
        if (element.kind == Kind::hull) {
            const std::string open = "<mesh filename=\"" + uri_of_hull() + "\"";
            result.push_back(
                collision_element(element.pose.translation, {},
                                  open + (words.declares_convex ? "><drake:declare_convex/></mesh>" : "/>"), words));
            continue;
        }
        const Vec3 rpy = short_roll_pitch_yaw(element.pose);
        const Element stated = stated_at(element, Pose::from_xyz_rpy(element.pose.translation, rpy));
        const bool as_parts = stated.kind == Kind::capsule && words.capsule.empty();
        for (const Element& part : as_parts ? capsule_parts(stated) : std::vector<Element>{stated}) {
            result.push_back(collision_element(part.pose.translation, part.kind == Kind::sphere ? Vec3{} : rpy,
                                               shape_text(part, words), words));
        }
    }
    return result;
}

static std::optional<Element> element_of(const xml::Element& collision,
                                         const std::map<std::string, std::string>& beside) {
    const xml::Element* geometry = collision.child("geometry");
    if (!geometry || geometry->children.empty()) {
        return {};
    }
    std::optional<Element> element = read_shape(*geometry->children.front(), beside);
    if (!element) {
        return {};
    }
    if (const xml::Element* origin = collision.child("origin")) {
        const Vec3 xyz = read_vector(*origin, "xyz", "0 0 0");
        // The rotation of a sphere does not matter.
        element->pose = element->kind == Kind::sphere ? Pose{.translation = xyz}
                                                      : Pose::from_xyz_rpy(xyz, read_vector(*origin, "rpy", "0 0 0"));
    }
    return element;
}

Elements elements_of_collisions(const xml::Element& parent, const std::map<std::string, std::string>& beside) {
    std::vector<Element> found;
    for (const xml::Element* collision : parent.children_named("collision")) {
        if (const std::optional<Element> element = element_of(*collision, beside)) {
            found.push_back(*element);
        }
    }
    return with_joined_capsules(found);
}

} // namespace foam
