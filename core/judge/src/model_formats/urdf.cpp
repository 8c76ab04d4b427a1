// URDF, and the formats of foam's own writers.
#include "formats.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::inline judge::model_formats {
namespace {

std::unique_ptr<RobotLoader> make_loader(const Registry& registry) {
    const RegisteredStage* stage = registry.find_for_extension(StageKind::robot_loader, "urdf");
    if (!stage) {
        throw Error(ErrorCode::plugin, "no plugin can read URDF files; `foam plugins --why` shows which plugins were "
                                       "loaded, and why others were not");
    }
    std::map<std::string, ParameterValue> given;
    for (const Parameter& parameter : stage->info.parameters) {
        if (parameter.name == "lenient") {
            given["lenient"] = true;
        }
    }
    return registry.make<RobotLoader>(stage->info.name, given);
}

std::string kind_of(const Geometry& geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry);
    return primitive ? to_string(primitive->kind) : "mesh";
}

void read_link(const Link& link, SphereFile& result) {
    std::set<std::string> others;
    std::vector<Sphere> spheres;
    for (const GeometryElement& element : link.collisions) {
        const auto* primitive = std::get_if<Primitive>(&element.geometry);
        if (primitive && primitive->kind == Primitive::Kind::sphere) {
            spheres.push_back({element.origin.translation, primitive->radius});
        } else {
            others.insert(kind_of(element.geometry));
        }
    }
    if (!others.empty()) {
        result.notes.push_back(
            fmt::format("link '{}' has collision geometry other than spheres ({}), which is not judged", link.name,
                        fmt::join(others, ", ")));
    }
    if (!spheres.empty()) {
        result.links.push_back({link.name, std::move(spheres)});
    }
}

} // namespace

void read_urdf(const std::string& text, const Registry& registry, SphereFile& result) {
    result.format = "URDF";
    QuietContext context;
    const Robot robot = make_loader(registry)->load(text, result.file, ResourceResolver::from_environment(), context);
    for (const Link& link : robot.links) {
        read_link(link, result);
    }
    for (const Joint& joint : robot.joints) {
        if (joint.kind == Joint::Kind::fixed) {
            result.fixed_joints[joint.child] = {joint.parent, joint.origin};
        }
    }
}

void read_written(const std::string& text, const std::string& extension, const Registry& registry, SphereFile& result) {
    const RegisteredStage* stage = registry.find_for_extension(StageKind::writer, extension);
    if (!stage) {
        throw Error(ErrorCode::plugin,
                    fmt::format("{}: no plugin reads sphere models of this format ({}); `foam plugins --why` shows "
                                "which plugins were loaded, and why others were not",
                                result.file.string(), extension));
    }
    result.format = extension;
    std::transform(extension.begin(), extension.end(), result.format.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    try {
        for (auto& [link, spheres] : registry.make<Writer>(stage->info.name)->read(text)) {
            result.links.push_back({link, std::move(spheres)});
        }
    } catch (const Error& error) {
        throw Error(ErrorCode::input, fmt::format("{}: {}; remedy: write the file again with {}", result.file.string(),
                                                  error.what(), stage->info.name));
    }
}

} // namespace foam::judge::model_formats
