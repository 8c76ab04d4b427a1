#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace foam::xml_models {
namespace {

/// The elements that state the attributes of the <geom> of a class, those of its parent class included.
using GeomClass = std::map<std::string, const xml::Element*, std::less<>>;

void take(GeomClass& attributes, const xml::Element& geom) {
    for (const auto& [key, value] : geom.attributes) {
        attributes[key] = &geom;
    }
}

class GeomWalk {
public:
    GeomWalk(const xml::Element& root, const std::string& file) : file_(file), paired_(names_in_pairs(root)) {
        GeomClass main;
        for (const xml::Element* defaults : root.children_named("default")) {
            main = add_classes(*defaults, main, true);
        }
        for (const xml::Element* world : root.children_named("worldbody")) {
            walk(*world, {.geom = nullptr, .body = world});
        }
    }

    std::vector<MjcfGeom> geoms;

private:
    /// Returns the attributes of the class itself.
    GeomClass add_classes(const xml::Element& element, GeomClass own, bool top) {
        if (const xml::Element* geom = element.child("geom")) {
            take(own, *geom);
        }
        const std::string* name = element.attribute("class");
        classes_[name ? *name : top ? "main" : ""] = own;
        if (top) {
            classes_[""] = own;
        }
        for (const xml::Element* child : element.children_named("default")) {
            add_classes(*child, own, false);
        }
        return own;
    }

    GeomClass class_of(const xml::Element& geom, const std::string& inherited) const {
        const std::string* name = geom.attribute("class");
        const std::string& wanted = name ? *name : inherited;
        const auto found = classes_.find(wanted);
        if (found == classes_.end() && !wanted.empty()) {
            throw Error(ErrorCode::input,
                        fmt::format("{}:{}: there is no default class '{}'", file_, geom.line, wanted));
        }
        return found == classes_.end() ? GeomClass{} : found->second;
    }

    /// Adds the geoms below an element. `place`: what holds there.
    void walk(const xml::Element& parent, MjcfGeom place) {
        const std::string* childclass = parent.attribute("childclass");
        place.inherited = childclass && !childclass->empty() ? *childclass : place.inherited;
        for (const auto& child : parent.children) {
            MjcfGeom inner = place;
            if (child->name == "geom") {
                const std::string* name = child->attribute("name");
                inner.geom = child.get();
                inner.stated = class_of(*child, place.inherited);
                take(inner.stated, *child);
                inner.paired = name && paired_.contains(*name);
                geoms.push_back(std::move(inner));
            } else if (child->name == "body" && !place.replicated) {
                inner.body = child.get();
                inner.frames.clear();
                walk(*child, std::move(inner));
            } else if (child->name == "frame" || child->name == "replicate") {
                inner.replicated |= child->name == "replicate";
                inner.frames.push_back(child.get());
                walk(*child, std::move(inner));
            }
        }
    }

    const std::string& file_;
    std::set<std::string> paired_;
    std::map<std::string, GeomClass> classes_;
};

/// Adds the bodies below an element. Returns how many there are in MuJoCo, `number` included.
std::size_t add_bodies_below(const xml::Element& parent, std::size_t number, bool copied,
                             std::multimap<std::string, const xml::Element*>& bodies) {
    for (const auto& child : parent.children) {
        if (child->name == "frame") {
            number = add_bodies_below(*child, number, copied, bodies);
        } else if (child->name == "replicate") {
            const std::string* count = child->attribute("count");
            const double copies = count ? parse_number(*count).value_or(1) : 1;
            const std::size_t inside = add_bodies_below(*child, 0, true, bodies);
            number += inside * static_cast<std::size_t>(std::clamp(copies, 1.0, 1e6));
        } else if (child->name == "body") {
            const std::string* name = child->attribute("name");
            ++number;
            if (!copied) {
                bodies.emplace(name && !name->empty() ? *name : "body_" + std::to_string(number), child.get());
            }
            number = add_bodies_below(*child, number, copied, bodies);
        }
    }
    return number;
}

} // namespace

const std::string* MjcfGeom::text(std::string_view attribute) const {
    const auto found = stated.find(attribute);
    return found == stated.end() ? nullptr : found->second->attribute(attribute);
}

bool MjcfGeom::sphere() const {
    const std::string* type = text("type");
    return (!type || *type == "sphere") && !geom->attribute("mesh");
}

bool MjcfGeom::collides() const {
    return paired || has_contact();
}

bool MjcfGeom::has_contact() const {
    const std::string *contype = text("contype"), *conaffinity = text("conaffinity");
    return !contype || *contype != "0" || !conaffinity || *conaffinity != "0";
}

bool MjcfGeom::is_ground() const {
    const std::string* type = text("type");
    return type && (*type == "plane" || *type == "hfield");
}

std::vector<MjcfGeom> geoms_of(const xml::Element& root, const std::string& file) {
    return GeomWalk(root, file).geoms;
}

std::multimap<std::string, const xml::Element*> bodies_of(const xml::Element& root) {
    std::multimap<std::string, const xml::Element*> bodies;
    std::size_t number = 0;
    for (const xml::Element* world : root.children_named("worldbody")) {
        bodies.emplace("world", world);
        number = add_bodies_below(*world, number, false, bodies);
    }
    return bodies;
}

namespace {

using Kind = Element::Kind;

std::string pose_attributes(const Pose& pose, const std::array<double, 4>& quat) {
    return attribute_text("pos", vector_text(pose.translation)) +
           (pose.rotation == Pose{}.rotation ? "" : attribute_text("quat", numbers_text(quat)));
}

/// Throws for a hull whose mesh MuJoCo refuses ("mesh volume is too small").
void require_volume(const Element& hull) {
    constexpr double least = 1e-14; // m³; mjMINVAL is 1e-15
    if (signed_volume(hull.hull->surface) < least) {
        throw Error(ErrorCode::output, "write.mjcf: MuJoCo refuses a hull with a volume of less than 1e-14 m³; remedy: "
                                       "another kind of element for this link, or other units");
    }
}

} // namespace

std::string MjcfShapes::attributes(const Element& element) {
    if (element.kind == Kind::hull) {
        require_volume(element);
        const std::string name = hull_prefix + std::to_string(next_++);
        std::string corners;
        for (const Vec3& p : element.hull->surface.vertices) {
            corners += (corners.empty() ? "" : " ") + vector_text(p);
        }
        meshes_.push_back("<mesh" + attribute_text("name", name) + own_ + attribute_text("vertex", corners) + "/>");
        return attribute_text("type", "mesh") + attribute_text("mesh", name) +
               attribute_text("pos", vector_text(element.pose.translation));
    }
    const std::array<double, 4> quat = quaternion(element.pose); // w x y z, as MuJoCo's
    const Element stated = stated_at(element, from_quaternion(element.pose.translation, quat));
    const bool by_half = stated.kind == Kind::box || stated.kind == Kind::ellipsoid; // half the edges, or the half axes
    const std::string size =
        by_half ? vector_text(stated.half) : numbers_text(std::array{stated.radius, stated.half.z});
    return attribute_text("type", to_string(stated.kind)) + attribute_text("size", size) +
           pose_attributes(element.pose, quat);
}

bool MjcfReader::recognises(std::string_view text) const {
    return xml::root_name(text) == "mujoco";
}

SphereFile MjcfReader::read(const std::string& text, const std::filesystem::path& file, Context&) const {
    const auto root = xml::parse(text, file.string(), ErrorCode::input);
    SphereFile result;
    result.file = file;
    result.format = "MJCF";
    if (root->name != "mujoco") {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}: <{}> is not <mujoco>", file.string(), root->line, root->name));
    }
    const MjcfElements elements(*root, file);
    std::map<const xml::Element*, std::string> names;
    for (const auto& [name, body] : bodies_of(*root)) {
        names.emplace(body, name);
    }
    std::size_t others = 0, visual = 0;
    std::set<std::string> reasons;
    for (const MjcfGeom& geom : geoms_of(*root, file.string())) {
        std::string why;
        if (!geom.collides()) {
            ++visual;
        } else if (const auto element = elements.element_of(geom, why)) {
            link_of(result, names.at(geom.body)).elements.add(*element);
        } else {
            ++others;
            reasons.insert(why);
        }
    }
    if (others > 0) {
        result.notes.push_back(fmt::format("{} geom{} no convex element ({}) and left out", others,
                                           others == 1 ? " is" : "s are", fmt::join(reasons, ", ")));
    }
    if (visual > 0) {
        result.notes.push_back(
            fmt::format("{} geom{} without contact and left out", visual, visual == 1 ? " is" : "s are"));
    }
    return result;
}

} // namespace foam::xml_models
