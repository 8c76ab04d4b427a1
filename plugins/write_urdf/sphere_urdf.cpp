#include "sphere_urdf.hpp"

#include "composed.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam {
namespace {

/// Returns the text of the robot's file, or one composed of what the robot has.
std::string urdf_of(const SphereModel& model, const std::string& writer) {
    const std::string_view root = model.robot ? xml::root_name(model.robot->source) : std::string_view();
    const bool own = model.robot && !model.robot->source.empty() && root != "mujoco" && root != "sdf";
    if (!model.robot || (!own && has_only_names(*model.robot))) {
        throw Error(ErrorCode::output,
                    writer + ": the robot has no URDF text to put the spheres into; remedy: give its URDF");
    }
    return own ? model.robot->source : composed_urdf(*model.robot);
}

/// The loader has warned of what the text lacks.
std::unique_ptr<const xml::Element> parsed(const std::string& text, const std::string& label) {
    std::vector<xml::Fault> known;
    return xml::parse_leniently(text, label, ErrorCode::output, known);
}

/// Returns the <collision> elements of a link, but for the planes, which no element covers.
std::vector<const xml::Element*> replaceable(const xml::Element& link) {
    std::vector<const xml::Element*> found = link.children_named("collision");
    std::erase_if(found, [](const xml::Element* collision) {
        const xml::Element* geometry = collision->child("geometry");
        return geometry && geometry->child("plane");
    });
    return found;
}

} // namespace

SphereUrdf::SphereUrdf(const SphereModel& model, std::string writer)
    : model_(model), writer_(std::move(writer)), text_(urdf_of(model, writer_)),
      root_(parsed(text_, model.robot->file.string())), editor_(text_) {
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

std::string SphereUrdf::place_of(const xml::Element& element) const {
    return text_ != model_.robot->source ? fmt::format("robot '{}'", shown(model_.robot->name))
                                         : fmt::format("{}:{}", model_.robot->file.string(), element.line);
}

std::string SphereUrdf::attribute_text(std::string_view value) const {
    return foam::attribute_text(value, text_);
}

void SphereUrdf::put_elements(const std::vector<LinkSpheres>& links, const UrdfWords& words,
                              const std::string& mesh_paths, Context& context) {
    bool capsules = false;
    HullNames names(file_name_of(model_));
    for (const LinkSpheres& elements : links) {
        const xml::Element& element = link(elements.link);
        const auto uri_of_hull = [&] {
            return attribute_text(uri_of_beside(names.next(elements.link), mesh_paths, model_, context));
        };
        editor_.replace_children(element, replaceable(element), collision_elements(elements, words, uri_of_hull));
        replaced_.insert(elements.link);
        capsules = capsules || std::any_of(elements.elements.shaped().begin(), elements.elements.shaped().end(),
                                           [](const Element& e) { return e.kind == Element::Kind::capsule; });
    }
    if (capsules && words.capsule == "capsule") {
        editor_.set_attribute(*root_, "version", "1.1");
    }
    for (const std::string& name : model_.without_collision) {
        editor_.replace_children(link(name), replaceable(link(name)), {});
        replaced_.insert(name);
    }
}

void SphereUrdf::move_references(const std::string& mesh_paths, Context& context) {
    const std::vector<Reference> references = references_of(text_, *root_, replaced_);
    const MovedReferences moved = moved_references(references, mesh_paths, model_);
    for (const Reference& reference : moved.moved) {
        editor_.replace(reference.span, attribute_text(reference.path));
    }
    for (const auto& [severity, message] : moved.messages) {
        context.log(severity, message);
    }
}

std::string file_name_of(const SphereModel& model) {
    return model.file.empty() ? model.robot->name + ".urdf" : model.file;
}

std::map<std::string, Elements> elements_of_urdf(const std::string& bytes,
                                                 const std::map<std::string, std::string>& beside) {
    const auto root = parsed(bytes, "URDF");
    std::map<std::string, Elements> result;
    for (const xml::Element* link : root->children_named("link")) {
        const std::string* name = link->attribute("name");
        const Elements elements = elements_of_collisions(*link, beside);
        if (name && elements.size() > 0) {
            result[*name].add(elements);
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
