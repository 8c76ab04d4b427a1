// load.urdf: URDF files (http://wiki.ros.org/urdf/XML). Numbers are read from the XML itself, alike in every locale.
// urdfdom checks the model too, so that the user learns here and not later in ROS that it refuses the model.
#include "reader.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::urdf {
namespace {

/// A collision mesh that was not found.
struct MissingMesh {
    const Link* link;
    const GeometryElement* element;
    ResolvedResource resource;
};

std::string package_of(const std::string& uri) {
    for (const char* scheme : {"package://", "model://"}) {
        if (uri.starts_with(scheme)) {
            const std::size_t begin = std::char_traits<char>::length(scheme);
            return uri.substr(begin, uri.find('/', begin) - begin);
        }
    }
    return {};
}

std::string explain(const std::vector<MissingMesh>& missing, const std::string& label) {
    const MissingMesh& first = missing.front();
    const std::string& uri = std::get<MeshReference>(first.element->geometry).uri;
    std::string text =
        fmt::format("{}:{}: mesh '{}' of link '{}' is not found", label, first.element->line, uri, first.link->name);
    if (first.resource.tried.empty()) {
        text += "; references are package://PACKAGE/FILE, model://, file:// or a path";
    } else {
        text += "; tried:";
        for (const std::filesystem::path& path : first.resource.tried) {
            text += "\n  " + path.string();
        }
    }
    if (missing.size() > 1) {
        text += fmt::format("\n{} more are missing, the next in line {}: '{}'", missing.size() - 1,
                            missing[1].element->line, std::get<MeshReference>(missing[1].element->geometry).uri);
    }
    if (const std::string package = package_of(uri); !package.empty()) {
        text += fmt::format("\nremedy: FOAM_PACKAGE_PATH=FOLDER, where FOLDER/{} is the package", package);
    }
    return text;
}

class UrdfLoader final : public RobotLoader {
public:
    explicit UrdfLoader(const Parameters& parameters) : lenient_(parameters.boolean("lenient")) {}

    bool recognises(std::string_view text) const override { return xml::root_name(text) == "robot"; }

    Robot load(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
               Context& context) const override {
        const Reader reader(file.string(), lenient_);
        const auto root = xml::parse(text, reader.label(), ErrorCode::input);
        Robot robot = read_robot(*root, file.stem().string(), reader, context);
        for (const std::string& complaint : complaints_of_urdfdom(text, *root)) {
            context.log(Severity::warning, fmt::format("ROS would refuse this model: urdfdom: {}", complaint));
        }
        robot.file = file;
        robot.source = text;
        resolve_collisions(robot, resources, reader.label());
        resolve_visuals(robot, resources, context);
        return robot;
    }

private:
    void resolve_collisions(Robot& robot, const ResourceResolver& resources, const std::string& label) const {
        std::vector<MissingMesh> missing;
        for (Link& link : robot.links) {
            CancellationCounter asking(64);
            for (GeometryElement& element : link.collisions) {
                asking.check();
                if (MeshReference* mesh = std::get_if<MeshReference>(&element.geometry)) {
                    ResolvedResource resource = resources.resolve(mesh->uri, robot.file.parent_path());
                    mesh->path = resource.path;
                    if (!resource.found()) {
                        missing.push_back({&link, &element, std::move(resource)});
                    }
                }
            }
        }
        if (!missing.empty() && !lenient_) {
            throw Error(ErrorCode::input, explain(missing, label));
        }
    }

    static void resolve_visuals(Robot& robot, const ResourceResolver& resources, Context& context) {
        std::vector<std::string> missing;
        for (Link& link : robot.links) {
            CancellationCounter asking(64);
            for (GeometryElement& element : link.visuals) {
                asking.check();
                if (MeshReference* mesh = std::get_if<MeshReference>(&element.geometry)) {
                    mesh->path = resources.resolve(mesh->uri, robot.file.parent_path()).path;
                    if (mesh->path.empty()) {
                        missing.push_back(mesh->uri);
                    }
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

} // namespace
} // namespace foam::urdf

FOAM_PLUGIN("load_urdf", "1.0", "Apache-2.0") {
    enrol.add<foam::urdf::UrdfLoader>(
        {.name = "load.urdf",
         .summary = "Reads a robot from a URDF file.",
         .reference = "http://wiki.ros.org/urdf/XML",
         .parameters = {foam::Parameter::boolean("lenient", false)
                            .doc(
                                "Takes spheres whose radius is not above 0 and collision meshes that are not found, as "
                                "`foam evaluate` needs it for sphere models of others.")
                            .source("A robot that is to become spheres must be whole.")},
         .extensions = {"urdf"}});
    enrol.add<foam::urdf::SphereReader>(
        {.name = "read.urdf",
         .summary = "Reads the collision elements of a URDF: primitives, and meshes that are convex.",
         .reference = "http://wiki.ros.org/urdf/XML/link",
         .extensions = {"urdf"},
         .uses = {"load.urdf", "load.mesh"}});
}
