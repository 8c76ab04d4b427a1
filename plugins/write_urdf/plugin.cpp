// write.urdf: the robot's URDF text with spheres in place of its collision geometry.
//
// Everything else keeps its bytes: comments, unknown elements, order, line ends, encoding. The exception: relative
// paths of the remaining meshes and textures (visuals, links without spheres) are changed so that they lead to their
// files from the folder of the new file.
#include "edit.hpp"
#include "references.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <map>
#include <set>

namespace foam {
namespace {

using LinkElements = std::map<std::string, const xml::Element*>;

LinkElements links_of(const xml::Element& robot) {
    LinkElements links;
    for (const xml::Element* link : robot.children_named("link")) {
        if (const std::string* name = link->attribute("name")) {
            links.emplace(*name, link);
        }
    }
    return links;
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

class UrdfWriter final : public Writer {
public:
    explicit UrdfWriter(const Parameters& parameters)
        : level_(static_cast<int>(parameters.integer("level"))), mesh_paths_(parameters.text("mesh_paths")) {}

    std::string write(const SphereModel& model, Context& context) const override {
        if (!model.robot || model.robot->source.empty()) {
            throw Error(ErrorCode::output, "write.urdf: the robot has no URDF text to put the spheres into");
        }
        const std::string& source = model.robot->source;
        const auto root = xml::parse(source, model.robot->file.string(), ErrorCode::output);
        const LinkElements links = links_of(*root);
        UrdfEditor editor(source);
        std::set<std::string> replaced;
        for (const LinkSpheres& link : spheres_by_link(model, level_)) {
            const auto it = links.find(link.link);
            if (it == links.end()) {
                throw Error(ErrorCode::output, fmt::format("write.urdf: the URDF text has no link '{}'", link.link));
            }
            editor.replace_collisions(*it->second, link.spheres);
            replaced.insert(link.link);
        }
        for (const std::string& name : model.without_collision) {
            if (const auto it = links.find(name); it != links.end()) {
                editor.replace_collisions(*it->second, {});
                replaced.insert(name);
            }
        }
        move_references(relative_references(source, *root, replaced), model, editor, context);
        return editor.result();
    }

    /// Returns the spheres by link, without links whose collision geometry has no sphere.
    std::map<std::string, std::vector<Sphere>> read(const std::string& bytes) const override {
        const auto root = xml::parse(bytes, "URDF", ErrorCode::output);
        std::map<std::string, std::vector<Sphere>> result;
        for (const auto& [name, link] : links_of(*root)) {
            for (const xml::Element* collision : link->children_named("collision")) {
                if (const std::optional<Sphere> sphere = read_sphere(*collision)) {
                    result[name].push_back(*sphere);
                }
            }
        }
        return result;
    }

private:
    /// Changes relative paths so that they lead to their files from the folder of the new file.
    void move_references(const std::vector<RelativeReference>& references, const SphereModel& model, UrdfEditor& editor,
                         Context& context) const {
        const std::string original = model.robot->file.string();
        const bool absolute = mesh_paths_ == "absolute";
        if (references.empty()) {
            return;
        }
        if (mesh_paths_ == "keep" || (model.folder.empty() && !absolute)) {
            context.log(mesh_paths_ == "keep" ? Severity::info : Severity::warning,
                        fmt::format("relative paths of meshes are kept as they are (the first: '{}'); they lead to "
                                    "their files from the folder of {}",
                                    references.front().path, original));
            return;
        }
        std::vector<std::string> moved, lost;
        for (const RelativeReference& reference : references) {
            const std::string path = reference_from(absolute ? std::filesystem::path() : model.folder, reference.path,
                                                    model.robot->file.parent_path());
            if (path.empty()) {
                lost.push_back(reference.path);
            } else if (path != reference.path) {
                moved.push_back(reference.path);
                editor.replace(reference.span, attribute_text(path, model.robot->source));
            }
        }
        if (!moved.empty()) {
            context.log(Severity::info, fmt::format("{} relative paths of meshes are rewritten so that they lead to "
                                                    "their files (the first: '{}')",
                                                    moved.size(), moved.front()));
        }
        if (!lost.empty()) {
            context.log(Severity::warning, fmt::format("{} relative paths of meshes lead to no file from the folder of "
                                                       "{} and are kept as they are (the first: '{}')",
                                                       lost.size(), original, lost.front()));
        }
    }

    int level_;
    std::string mesh_paths_;
};

} // namespace
} // namespace foam

FOAM_PLUGIN("write_urdf", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::UrdfWriter>(
        {.name = "write.urdf",
         .summary = "Writes the robot's URDF text with spheres in place of its collision geometry, and nothing else "
                    "changed but "
                    "relative paths.",
         .reference = "http://wiki.ros.org/urdf/XML",
         .parameters = {Parameter::integer("level", -1)
                            .bounds(-1, 32)
                            .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                            .source("The finest level is the one that is measured and proved."),
                        Parameter::choice("mesh_paths", {"rewrite", "keep", "absolute"}, "rewrite")
                            .doc("Relative paths of meshes and textures: rewritten so that they lead to their files "
                                 "from the new file's folder, kept as written, or made absolute.")
                            .source("Viewers look for meshes from the file that names them.")},
         .extensions = {"urdf"}});
}
