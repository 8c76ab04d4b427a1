#include "sphere_urdf.hpp"

#include "references.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam {
namespace {

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

/// Returns the sphere of a <collision>; nothing if it has another geometry. The rotation of a sphere does not matter.
std::optional<Sphere> read_sphere(const xml::Element& collision) {
    const xml::Element* geometry = collision.child("geometry");
    const xml::Element* sphere = geometry ? geometry->child("sphere") : nullptr;
    if (!sphere) {
        return {};
    }
    const double radius = read_numbers(*sphere, "radius", 1, "").front();
    const xml::Element* origin = collision.child("origin");
    if (!origin) {
        return Sphere{{}, radius};
    }
    const std::vector<double> xyz = read_numbers(*origin, "xyz", 3, "0 0 0");
    return Sphere{{xyz[0], xyz[1], xyz[2]}, radius};
}

std::vector<std::string> sphere_elements(const std::vector<Sphere>& spheres, const std::string& properties) {
    std::vector<std::string> elements;
    for (const Sphere& sphere : spheres) {
        elements.push_back("<collision><origin xyz=\"" + number_text(sphere.center.x) + " " +
                           number_text(sphere.center.y) + " " + number_text(sphere.center.z) +
                           "\" rpy=\"0 0 0\"/><geometry><sphere radius=\"" + number_text(sphere.radius) +
                           "\"/></geometry>" + properties + "</collision>");
    }
    return elements;
}

std::unique_ptr<const xml::Element> urdf_of(const SphereModel& model, const std::string& writer) {
    if (!model.robot || model.robot->source.empty()) {
        throw Error(ErrorCode::output,
                    writer + ": the robot has no URDF text to put the spheres into; remedy: give its URDF");
    }
    return xml::parse(model.robot->source, model.robot->file.string(), ErrorCode::output);
}

} // namespace

SphereUrdf::SphereUrdf(const SphereModel& model, std::string writer)
    : model_(model), writer_(std::move(writer)), root_(urdf_of(model, writer_)), editor_(model.robot->source) {
    for (const auto& child : root_->children) {
        if (const std::string* name = child->attribute("name")) {
            elements_.emplace(std::pair(child->name, *name), child.get());
        }
    }
}

const xml::Element& SphereUrdf::element(const char* kind, const std::string& name) const {
    const auto it = elements_.find({kind, name});
    if (it == elements_.end()) {
        throw Error(ErrorCode::output, fmt::format("{}: the URDF text has no {} '{}'", writer_, kind, name));
    }
    return *it->second;
}

const xml::Element& SphereUrdf::link(const std::string& name) const {
    return element("link", name);
}

const xml::Element& SphereUrdf::joint(const std::string& name) const {
    return element("joint", name);
}

std::string SphereUrdf::attribute_text(std::string_view value) const {
    return foam::attribute_text(value, model_.robot->source);
}

void SphereUrdf::put_spheres(const std::vector<LinkSpheres>& links, const std::string& properties) {
    for (const LinkSpheres& spheres : links) {
        const xml::Element& element = link(spheres.link);
        editor_.replace_children(element, element.children_named("collision"),
                                 sphere_elements(spheres.spheres, properties));
        replaced_.insert(spheres.link);
    }
    for (const std::string& name : model_.without_collision) {
        editor_.replace_children(link(name), link(name).children_named("collision"), {});
        replaced_.insert(name);
    }
}

void SphereUrdf::move_references(const std::string& mesh_paths, Context& context) {
    const std::vector<Reference> references = references_of(model_.robot->source, *root_, replaced_);
    const MovedReferences moved = moved_references(references, mesh_paths, model_);
    for (const Reference& reference : moved.moved) {
        editor_.replace(reference.span, attribute_text(reference.path));
    }
    for (const auto& [severity, message] : moved.messages) {
        context.log(severity, message);
    }
}

std::map<std::string, std::vector<Sphere>> spheres_of_urdf(const std::string& bytes) {
    const auto root = xml::parse(bytes, "URDF", ErrorCode::output);
    std::map<std::string, std::vector<Sphere>> result;
    for (const xml::Element* link : root->children_named("link")) {
        const std::string* name = link->attribute("name");
        for (const xml::Element* collision : link->children_named("collision")) {
            if (const std::optional<Sphere> sphere = read_sphere(*collision); name && sphere) {
                result[*name].push_back(*sphere);
            }
        }
    }
    return result;
}

Parameter mesh_paths_parameter() {
    return Parameter::choice("mesh_paths", {"rewrite", "keep", "absolute", "package"}, "rewrite")
        .doc("Relative paths of meshes and textures: rewritten so that they lead to their files from the new file's "
             "folder; kept as written; made absolute, and package:// and model:// with them; or made package:// of the "
             "package that the file lies in.")
        .source("Viewers look for meshes from the file that names them; DART refuses a robot whose visual mesh is "
                "missing.");
}

} // namespace foam
