// load.urdf: URDF files (http://wiki.ros.org/urdf/XML). Numbers are read from the XML itself, alike in every locale.
// urdfdom checks the model too, so that the user learns here and not later in ROS that it refuses the model.
#include "reader.hpp"
#include "xacro.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::urdf {
namespace {

/// Returns why a mesh is not found: the place in the robot, the places that were looked at, the remedy.
std::string explain(const GeometryElement& element, const Link& link, const std::string& uri,
                    const ResolvedResource& resource, const std::string& label) {
    std::string text = fmt::format("{}:{}: mesh '{}' of link '{}' is not found", label, element.line, shown(uri),
                                   shown(link.name));
    if (is_xacro_expression(uri)) {
        return text + "; it is a xacro expression; remedy: run xacro first: xacro IN.xacro > OUT.urdf";
    }
    if (resource.tried.empty()) {
        text += "; references are package://PACKAGE/FILE, model://, file:// or a path";
    } else {
        text += "; tried:";
        for (const std::filesystem::path& path : resource.tried) {
            text += "\n  " + shown(path.string());
        }
    }
    if (const std::string package = package_of(uri); !package.empty()) {
        text += fmt::format("\nremedy: --package {0}=FOLDER, where FOLDER is the package, or FOAM_PACKAGE_PATH=FOLDER, "
                            "where FOLDER/{0} is it",
                            shown(package));
    }
    return text;
}

class UrdfLoader final : public RobotLoader {
public:
    explicit UrdfLoader(bool lenient) : lenient_(lenient) {}
    explicit UrdfLoader(const Parameters& parameters) : UrdfLoader(parameters.boolean("lenient")) {}

    bool recognises(std::string_view text) const override { return root_name_of(text) == "robot"; }

    Robot load(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
               Context& context) const override {
        return load_labelled(text, file.string(), file, resources, context);
    }

    /// Returns the robot of a text whose lines messages name by `label`.
    Robot load_labelled(const std::string& given, const std::string& label, const std::filesystem::path& file,
                        const ResourceResolver& resources, Context& context) const {
        const Reader reader(label, lenient_);
        const std::string text = utf8_text(given, reader);
        std::vector<xml::Fault> faults;
        const auto root = xml::parse_leniently(text, reader.label(), ErrorCode::input, faults);
        for (const xml::Fault& fault : faults) {
            reader.warn(fault.line, fault.what);
        }
        Robot robot = read_robot(*root, file.stem().string(), reader, context);
        robot.file = file;
        robot.source = text;
        resolve(robot, resources, reader);
        reader.report(context);
        for (const std::string& complaint : complaints_of_urdfdom(text, *root)) {
            context.log(Severity::warning, fmt::format("ROS would refuse this model: urdfdom: {}", complaint));
        }
        tell_missing_visuals(robot, context);
        return robot;
    }

private:
    /// Finds the files of meshes. One that is missing is an error for who needs it.
    static void resolve(Robot& robot, const ResourceResolver& resources, const Reader& reader) {
        const std::filesystem::path folder = robot.file.parent_path();
        for (Link& link : robot.links) {
            CancellationCounter asking(64);
            for (auto* elements : {&link.collisions, &link.visuals}) {
                for (GeometryElement& element : *elements) {
                    asking.check();
                    MeshReference* mesh = std::get_if<MeshReference>(&element.geometry);
                    if (!mesh) {
                        continue;
                    }
                    const ResolvedResource found = resources.resolve_leniently(mesh->uri, folder);
                    mesh->path = found.path;
                    if (!found.found()) {
                        mesh->problem = explain(element, link, mesh->uri, found, reader.label());
                    } else if (!found.fault.empty()) {
                        const std::string cure = found.path.lexically_proximate(folder).string();
                        reader.warn(element.line,
                                    fmt::format("mesh '{}' is taken to be {}: {}; remedy: filename=\"{}\"",
                                                shown(mesh->uri), shown(found.path.string()), found.fault,
                                                shown(cure)));
                    }
                }
            }
        }
    }

    static void tell_missing_visuals(const Robot& robot, Context& context) {
        std::vector<std::string> missing;
        for (const Link& link : robot.links) {
            for (const GeometryElement& element : link.visuals) {
                const MeshReference* mesh = std::get_if<MeshReference>(&element.geometry);
                if (mesh && mesh->path.empty()) {
                    missing.push_back(mesh->uri);
                }
            }
        }
        if (!missing.empty()) {
            context.log(Severity::warning,
                        fmt::format("{} visual meshes are not found and are left out of pictures, the first: "
                                    "'{}'",
                                    missing.size(), missing.front()));
        }
    }

    bool lenient_;
};

class XacroLoader final : public RobotLoader {
public:
    explicit XacroLoader(const Parameters& parameters) : arguments_(parameters.text("args")), loader_(false) {}

    /// A URDF often keeps the namespace of the xacro that it was made from: the ending tells them apart.
    bool recognises(std::string_view text) const override { return loader_.recognises(text); }

    Robot load(const std::string&, const std::filesystem::path& file, const ResourceResolver& resources,
               Context& context) const override {
        Robot robot = loader_.load_labelled(expanded_xacro(file, arguments_), file.string() + " (expanded)", file,
                                            resources, context);
        robot.further_files = included_by_xacro(file, arguments_);
        return robot;
    }

private:
    std::string arguments_;
    UrdfLoader loader_;
};

} // namespace
} // namespace foam::urdf

FOAM_PLUGIN("load_urdf", "1.0", "Apache-2.0") {
    enrol.add<foam::urdf::UrdfLoader>(
        {.name = "load.urdf",
         .summary = "Reads a robot from a URDF file.",
         .reference = "http://wiki.ros.org/urdf/XML",
         .parameters = {foam::Parameter::boolean("lenient", false)
                            .doc("Takes spheres whose radius is not above 0, as `foam evaluate` needs it for sphere "
                                 "models of others.")
                            .source("A robot that is to become spheres must be whole.")},
         .extensions = {"urdf"}});
    enrol.add<foam::urdf::XacroLoader>(
        {.name = "load.xacro",
         .summary = "Reads a robot from a xacro file by the program xacro.",
         .reference = "http://wiki.ros.org/xacro",
         .parameters = {foam::Parameter::text("args", "")
                            .doc("Arguments of the file, NAME:=VALUE, one a line; 'args' of a recipe's robot.")
                            .source("None: the file's own defaults.")},
         .extensions = {"xacro"}});
    enrol.add<foam::urdf::SphereReader>(
        {.name = "read.urdf",
         .summary = "Reads the collision elements of a URDF: primitives, and meshes that are convex.",
         .reference = "http://wiki.ros.org/urdf/XML/link",
         .extensions = {"urdf"},
         .uses = {"load.urdf", "load.mesh"}});
}
