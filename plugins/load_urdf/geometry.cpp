#include "reader.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::urdf {
namespace {

double positive(const xml::Element& element, std::string_view attribute, const Reader& reader) {
    const double value = reader.required_number(element, attribute);
    if (!(value > 0)) {
        reader.fail(element,
                    fmt::format("<{} {}=\"{}\"> must be above 0", element.name, attribute, number_text(value)));
    }
    return value;
}

foam::Element read_box(const xml::Element& element, const Reader& reader) {
    reader.required(element, "size");
    const Vec3 size = *reader.vector(element, "size");
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
        reader.fail(element, "<box size> must be above 0 along x, y and z");
    }
    return foam::Element::box(size);
}

foam::Element read_capsule(const xml::Element& element, const Reader& reader) {
    const double radius = positive(element, "radius", reader);
    const double length = reader.required_number(element, "length");
    if (length < 0) {
        reader.fail(element, "<capsule length> must not be negative");
    }
    return foam::Element::capsule(radius, length);
}

MeshReference read_mesh(const xml::Element& element, const Reader& reader) {
    MeshReference mesh{.uri = reader.required(element, "filename"), .path = {}};
    mesh.scale = reader.vector(element, "scale").value_or(Vec3{1, 1, 1});
    if (mesh.scale.x == 0 || mesh.scale.y == 0 || mesh.scale.z == 0) {
        reader.fail(element, fmt::format("<mesh scale=\"{}\"> of '{}' flattens the mesh to nothing: no factor may be 0",
                                         *element.attribute("scale"), mesh.uri));
    }
    return mesh;
}

Geometry read_shape(const xml::Element& shape, const Reader& reader) {
    if (shape.name == "mesh") {
        return read_mesh(shape, reader);
    }
    if (shape.name == "box") {
        return read_box(shape, reader);
    }
    if (shape.name == "sphere") {
        return foam::Element::sphere(reader.lenient() ? reader.required_number(shape, "radius")
                                                      : positive(shape, "radius", reader));
    }
    if (shape.name == "cylinder") {
        const double radius = positive(shape, "radius", reader);
        return foam::Element::cylinder(radius, positive(shape, "length", reader));
    }
    if (shape.name == "capsule") {
        return read_capsule(shape, reader);
    }
    if (shape.name == "drake:ellipsoid") { // Drake's extension of the format
        const double a = positive(shape, "a", reader), b = positive(shape, "b", reader);
        return foam::Element::ellipsoid({a, b, positive(shape, "c", reader)});
    }
    reader.fail(shape, fmt::format("unknown geometry <{}>; known: box, capsule, cylinder, mesh, sphere, "
                                   "drake:ellipsoid",
                                   shape.name));
}

} // namespace

GeometryElement read_geometry_element(const xml::Element& element, const Reader& reader) {
    const xml::Element* geometry = reader.only_child(element, "geometry");
    if (!geometry || geometry->children.empty()) {
        reader.fail(element, fmt::format("<{}> has no geometry", element.name));
    }
    if (geometry->children.size() > 1) {
        reader.fail(*geometry->children[1],
                    fmt::format("a second shape, <{}>, in one <geometry>; give it a <{}> of its own",
                                geometry->children[1]->name, element.name));
    }
    const std::string* name = element.attribute("name");
    return {.origin = reader.origin(element),
            .geometry = read_shape(*geometry->children.front(), reader),
            .name = name ? *name : "",
            .line = element.line};
}

} // namespace foam::urdf
