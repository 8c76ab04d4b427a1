#include "geoms.hpp"

#include "fit.hpp"
#include "orientation.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <array>

namespace foam::mjcf {
namespace {

using Kind = Element::Kind;

/// Returns the kind of a primitive. Fails on any other type.
Kind kind_of(const Geom& geom) {
    static constexpr std::array kinds{Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::ellipsoid};
    for (const Kind kind : kinds) {
        if (geom.type() == to_string(kind)) {
            return kind;
        }
    }
    geom.attributes.fail("type", "it is none of plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh, sdf");
}

/// Returns the first `count` numbers of the size, which are above 0; of a capsule the second may be 0.
std::vector<double> size_of(const Geom& geom, std::size_t count) {
    const std::vector<double> size = geom.attributes.numbers("size", 1, 3);
    if (size.size() < count) {
        geom.attributes.fail("size", fmt::format("a {} needs {}", geom.type(), counted(count, "number")));
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!(size[i] > 0 || (size[i] == 0 && i == 1 && geom.type() == "capsule"))) {
            geom.attributes.fail("size", "a size must be above 0");
        }
    }
    return size;
}

/// Returns the primitive with half its length along z, or half its edges.
Element sized(Kind kind, const std::vector<double>& size) {
    switch (kind) {
    case Kind::sphere:
        return Element::sphere(size[0]);
    case Kind::capsule:
        return Element::capsule(size[0], 2 * size[1]);
    case Kind::cylinder:
        return Element::cylinder(size[0], 2 * size[1]);
    case Kind::ellipsoid:
        return Element::ellipsoid({size[0], size[1], size[2]});
    default:
        return Element::box(Vec3{size[0], size[1], size[2]} * 2);
    }
}

/// Returns the primitive between two points. A box and an ellipsoid are as wide as they are high.
Element between(const Geom& geom, Kind kind, const std::vector<double>& v) {
    const Vec3 from{v[0], v[1], v[2]}, to{v[3], v[4], v[5]};
    const double half = norm(to - from) / 2;
    if (kind == Kind::sphere) {
        geom.attributes.fail("fromto", "it is for capsule, cylinder, box and ellipsoid");
    }
    if (half < 1e-14) {
        geom.attributes.fail("fromto", "the points are too close");
    }
    const double width = size_of(geom, 1)[0];
    const bool round = kind == Kind::capsule || kind == Kind::cylinder;
    Element element = sized(kind, round ? std::vector{width, half} : std::vector{width, width, half});
    element.pose = turned_z(from - to); // as MuJoCo does: it matters for a box
    element.pose.translation = (from + to) * 0.5;
    return element;
}

Element fitted_to_mesh(const Geom& geom, Kind kind) {
    if (geom.attributes.text("fromto")) {
        geom.attributes.fail("fromto", "it cannot be used with a mesh");
    }
    const std::string inertia = geom.mesh->attributes().word("inertia", "legacy");
    try {
        return fitted(geom.mesh->mesh(), {.kind = kind,
                                          .inertia = inertia,
                                          .by_box = geom.model->settings.fitaabb,
                                          .scale = geom.attributes.number("fitscale").value_or(1)});
    } catch (const Error& error) {
        if (error.code() != ErrorCode::geometry) {
            throw;
        }
        geom.attributes.fail("mesh", error.what());
    }
}

Element primitive_of(const Geom& geom) {
    const Kind kind = kind_of(geom);
    const std::vector<double> ends = geom.attributes.numbers("fromto", 6, 6);
    if (geom.mesh) {
        return moved(fitted_to_mesh(geom, kind), pose_of(geom.attributes, geom.model->settings));
    }
    if (!ends.empty()) {
        return between(geom, kind, ends);
    }
    Element element = sized(kind, size_of(geom, kind == Kind::sphere                           ? 1
                                                : kind == Kind::box || kind == Kind::ellipsoid ? 3
                                                                                               : 2));
    element.pose = pose_of(geom.attributes, geom.model->settings);
    return element;
}

/// Returns the element with the pose of its geometry in `origin`, as the Robot has it.
GeometryElement element_of(const Geom& geom) {
    GeometryElement element{.origin = geom.frame, .geometry = {}, .name = geom.name, .line = geom.node->element->line};
    if (geom.is_mesh()) {
        element.origin = geom.frame * pose_of(geom.attributes, geom.model->settings);
        return element;
    }
    Element primitive = primitive_of(geom);
    element.origin = geom.frame * primitive.pose;
    primitive.pose = {};
    element.geometry = primitive;
    return element;
}

std::optional<std::array<double, 4>> colour_of(const Attributes& attributes) {
    const std::vector<double> v = attributes.numbers("rgba", 4, 4);
    return v.empty() ? std::nullopt : std::optional(std::array{v[0], v[1], v[2], v[3]});
}

/// Returns the colour that a geom states, or that of its material.
std::shared_ptr<const Material> material_of(const Geom& geom) {
    Material material{.name = geom.attributes.word("material"), .rgba = {}, .texture = {}};
    const auto found = geom.model->materials.find(material.name);
    if (found != geom.model->materials.end()) {
        material.rgba = colour_of(geom.model->classes.of(*found->second, ""));
    }
    if (const auto own = colour_of(geom.attributes); own && (!material.rgba || geom.node->attribute("rgba"))) {
        material.rgba = own;
    }
    return material.name.empty() && !material.rgba ? nullptr : std::make_shared<const Material>(std::move(material));
}

} // namespace

bool Geom::collides() const {
    return paired || attributes.number("contype").value_or(1) != 0 || attributes.number("conaffinity").value_or(1) != 0;
}

bool Geom::is_seen() const {
    return !is_ground() && (!collides() || attributes.number("group").value_or(0) < 3);
}

void Shapes::prepare(Geom& geom) {
    if (geom.is_ground()) {
        return;
    }
    const std::string* mesh = geom.attributes.text("mesh");
    if (geom.is_mesh() && !mesh) {
        geom.attributes.fail("type", "it names no mesh; remedy: mesh=\"…\"");
    }
    if (!mesh) {
        return;
    }
    geom.mesh = &meshes_.named(*geom.model, *mesh, geom.attributes);
    geom.mesh->wanted = geom.mesh->wanted || !geom.is_mesh() || !geom.mesh->is_plain();
    geom.mesh->hull_wanted = geom.mesh->hull_wanted || (hulls_ && geom.type() == "mesh" && geom.collides());
    if (geom.collides() && !geom.mesh->found()) {
        geom.mesh->fail_missing(*geom.node);
    }
}

GeometryElement Shapes::collision(const Geom& geom) const {
    GeometryElement element = element_of(geom);
    if (geom.is_mesh()) {
        element.geometry = hulls_ && geom.type() == "mesh" ? geom.mesh->hull() : geom.mesh->surface();
    }
    return element;
}

std::optional<GeometryElement> Shapes::visual(const Geom& geom, Context& context) const {
    if (geom.mesh && !geom.mesh->found()) {
        context.log(Severity::warning,
                    fmt::format("{}: its mesh is not found; the geom is left out of pictures", geom.node->place()));
        return {};
    }
    try {
        GeometryElement element = element_of(geom);
        if (geom.is_mesh()) {
            element.geometry = geom.mesh->surface();
        }
        element.material = material_of(geom);
        return element;
    } catch (const Error& error) {
        context.log(Severity::warning, fmt::format("a geom is left out of pictures: {}", error.what()));
        return {};
    }
}

} // namespace foam::mjcf
