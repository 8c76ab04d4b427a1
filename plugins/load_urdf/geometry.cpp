#include "reader.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::urdf {
namespace {

/// Reads the sizes of a primitive. One that is 0 is read as a little thickness, so that a sheet or a line is a solid
/// that contains it.
class Sizes {
public:
    explicit Sizes(const xml::Element& shape, const Reader& reader) : shape_(shape), reader_(reader) {}

    double length(std::string_view attribute) { return checked(attribute, reader_.required_number(shape_, attribute)); }
    Vec3 lengths(std::string_view attribute) {
        reader_.required(shape_, attribute);
        const Vec3 size = reader_.vector(shape_, attribute).value_or(Vec3{});
        return {checked(attribute, size.x), checked(attribute, size.y), checked(attribute, size.z)};
    }
    /// Warns of sizes that are 0, and returns whether all are, as those of placeholders.
    bool nothing() const {
        if (zeros_ == count_) {
            reader_.warn(shape_, fmt::format("a <{}> without size is left out; remedy: remove its element, or give it "
                                             "a size",
                                             shape_.name));
        } else if (zeros_ > 0) {
            reader_.warn(shape_, fmt::format("a flat <{}> is read {} mm thick; remedy: give it a thickness",
                                             shape_.name, number_text(1000 * thickness)));
        }
        return zeros_ == count_;
    }

private:
    static constexpr double thickness = 1e-6; ///< m

    double checked(std::string_view attribute, double value) {
        if (value < 0) {
            reader_.fail(shape_, fmt::format("<{} {}=\"{}\"> must be above 0", shape_.name, attribute,
                                             *shape_.attribute(attribute)));
        }
        ++count_;
        zeros_ += value == 0;
        return value == 0 ? thickness : value;
    }

    const xml::Element& shape_;
    const Reader& reader_;
    int count_ = 0, zeros_ = 0;
};

/// Returns the factors of a mesh. One number alone is one for all axes.
Vec3 read_scale(const xml::Element& element, const Reader& reader) {
    const std::string* text = element.attribute("scale");
    if (!text || words(*text).size() != 1 || !parse_number(words(*text).front())) {
        return reader.vector(element, "scale").value_or(Vec3{1, 1, 1});
    }
    const double factor = *reader.number(element, "scale");
    reader.warn(element,
                fmt::format("<mesh scale=\"{0}\"> has one number; remedy: scale=\"{0} {0} {0}\"", number_text(factor)));
    return {factor, factor, factor};
}

MeshReference read_mesh(const xml::Element& element, const Reader& reader) {
    const std::string* file = element.attribute("filename"); // a xacro expression is a mesh that is not found
    MeshReference mesh{.uri = file && !file->empty() ? *file : reader.required(element, "filename"), .path = {}};
    mesh.scale = read_scale(element, reader);
    if (mesh.scale.x == 0 || mesh.scale.y == 0 || mesh.scale.z == 0) {
        reader.fail(element, fmt::format("<mesh scale=\"{}\"> of '{}' flattens the mesh to nothing: no factor may be 0",
                                         *element.attribute("scale"), mesh.uri));
    }
    return mesh;
}

/// Returns a primitive; nothing for one without size.
std::optional<foam::Element> read_primitive(const xml::Element& shape, const Reader& reader) {
    if (shape.name == "sphere" && reader.lenient()) {
        return foam::Element::sphere(reader.required_number(shape, "radius"));
    }
    Sizes sizes(shape, reader);
    foam::Element element;
    if (shape.name == "box") {
        element = foam::Element::box(sizes.lengths("size"));
    } else if (shape.name == "sphere") {
        element = foam::Element::sphere(sizes.length("radius"));
    } else if (shape.name == "drake:ellipsoid") { // Drake's extension of the format
        const double a = sizes.length("a"), b = sizes.length("b");
        element = foam::Element::ellipsoid({a, b, sizes.length("c")});
    } else if (const double radius = sizes.length("radius"); shape.name == "cylinder") {
        element = foam::Element::cylinder(radius, sizes.length("length"));
    } else if (reader.required_number(shape, "length") == 0) { // a capsule may be a sphere
        element = foam::Element::capsule(radius, 0);
    } else {
        element = foam::Element::capsule(radius, sizes.length("length"));
    }
    return sizes.nothing() ? std::nullopt : std::optional(element);
}

std::optional<Geometry> read_shape(const xml::Element& shape, const Reader& reader) {
    constexpr std::array primitives{"box", "capsule", "cylinder", "sphere", "drake:ellipsoid"};
    if (shape.name == "mesh") {
        return read_mesh(shape, reader);
    }
    if (shape.name == "plane") { // of Bullet
        reader.warn(shape, "a <plane> stays in the file, and no element covers it");
        return {};
    }
    if (std::find(primitives.begin(), primitives.end(), shape.name) != primitives.end()) {
        return read_primitive(shape, reader);
    }
    reader.fail(shape, fmt::format("unknown geometry <{}>; known: box, capsule, cylinder, mesh, sphere, "
                                   "drake:ellipsoid, plane; remedy: one of these, or a mesh",
                                   shape.name));
}

/// Returns whether nothing in an element could be meant as its geometry.
bool is_empty(const xml::Element& element, const xml::Element* geometry) {
    return (!geometry || geometry->children.empty()) &&
           std::all_of(element.children.begin(), element.children.end(), [](const auto& child) {
               return child->name == "geometry" || child->name == "origin" || child->name == "material";
           });
}

} // namespace

std::optional<GeometryElement> read_geometry_element(const xml::Element& element, const Reader& reader) {
    const xml::Element* geometry = reader.only_child(element, "geometry");
    if (is_empty(element, geometry)) {
        reader.warn(element, fmt::format("a <{}> without geometry is left out; remedy: remove it", element.name));
        return {};
    }
    if (!geometry || geometry->children.empty()) {
        reader.fail(element, fmt::format("<{}> has no geometry", element.name));
    }
    if (geometry->children.size() > 1) {
        reader.warn(
            *geometry->children[1],
            fmt::format("a second shape, <{}>, in one <geometry> is not read; remedy: give it a <{}> of its own",
                        geometry->children[1]->name, element.name));
    }
    const Pose origin = reader.origin(element);
    auto shape = read_shape(*geometry->children.front(), reader);
    if (!shape) {
        return {};
    }
    const std::string* name = element.attribute("name");
    return GeometryElement{
        .origin = origin, .geometry = std::move(*shape), .name = name ? *name : "", .line = element.line};
}

} // namespace foam::urdf
