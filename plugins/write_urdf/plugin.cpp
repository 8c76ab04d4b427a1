// write.urdf: the robot's own URDF text with spheres in place of its collision geometry.
//
// Everything else keeps its bytes: comments, unknown elements, order, line ends, encoding. References to meshes stay as
// they are written; a relative one in what stays (visuals, links without spheres) leads to its file only from the
// folder of the original, which the log says.
#include "edit.hpp"

#include <foam/error.hpp>
#include <foam/plugin.hpp>
#include <foam/text.hpp>

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

/// The first mesh reference in what is kept that is a relative path; empty if there is none.
std::string first_relative_mesh(const xml::Element& robot, const std::set<std::string>& replaced) {
    for (const xml::Element* link : robot.children_named("link")) {
        const std::string* name = link->attribute("name");
        for (const auto& child : link->children) {
            const bool kept =
                child->name == "visual" || (child->name == "collision" && !replaced.contains(name ? *name : ""));
            const xml::Element* geometry = kept ? child->child("geometry") : nullptr;
            const xml::Element* mesh = geometry ? geometry->child("mesh") : nullptr;
            const std::string* file = mesh ? mesh->attribute("filename") : nullptr;
            if (file && file->find("://") == std::string::npos && !file->starts_with('/')) {
                return *file;
            }
        }
    }
    return {};
}

[[noreturn]] void unreadable(const xml::Element& element, const std::string& why) {
    throw Error(ErrorCode::output, fmt::format("URDF:{}: <{}> {}", element.line, element.name, why));
}

/// The numbers of an attribute; `fallback` if it is absent.
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

/// The sphere of a <collision>, nothing if its geometry is another one. The rotation of a sphere does not matter.
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
    explicit UrdfWriter(const Parameters& parameters) : level_(static_cast<int>(parameters.integer("level"))) {}

    std::string write(const SphereModel& model, Context& context) const override {
        if (!model.robot || model.robot->source.empty()) {
            throw Error(ErrorCode::output, "write.urdf: the robot has no URDF text to put the spheres into");
        }
        const std::string& source = model.robot->source;
        const auto root = xml::parse(source, model.robot->file.string(), ErrorCode::output);
        const LinkElements links = links_of(*root);
        CollisionEditor editor(source);
        std::set<std::string> replaced;
        for (const LinkSpheres& link : spheres_by_link(model, level_)) {
            const auto it = links.find(link.link);
            if (it == links.end()) {
                throw Error(ErrorCode::output, fmt::format("write.urdf: the URDF text has no link '{}'", link.link));
            }
            editor.replace_collisions(*it->second, link.spheres);
            replaced.insert(link.link);
        }
        if (const std::string mesh = first_relative_mesh(*root, replaced); !mesh.empty()) {
            context.log(Severity::info,
                        fmt::format("relative mesh paths are kept as they are (the first: '{}'); they lead "
                                    "to their files from the folder of {}",
                                    mesh, model.robot->file.string()));
        }
        return editor.result();
    }

    /// Links whose collision geometry holds no sphere are not in the result.
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
    int level_;
};

} // namespace
} // namespace foam

FOAM_PLUGIN("write_urdf", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::UrdfWriter>(
        {.name = "write.urdf",
         .summary =
             "Writes the robot's URDF text with spheres in place of its collision geometry, and nothing else changed.",
         .reference = "http://wiki.ros.org/urdf/XML",
         .parameters = {Parameter::integer("level", -1)
                            .bounds(-1, 32)
                            .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                            .source("The finest level is the one that is measured and proved.")},
         .extensions = {"urdf"}});
}
