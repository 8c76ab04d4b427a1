#include "reader.hpp"

#include "program_text.hpp"

#include <foam/base/error.hpp>
#include <foam/base/program.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <cstring>

namespace foam::load_usd {
namespace {

using Json = nlohmann::json;

/// What robot_of_usd.py prints of a pose: rows of rotation and translation.
Pose pose_of(const Json& rows) {
    Pose pose;
    for (std::size_t i = 0; i < 3; ++i) {
        pose.rotation[i] = {rows[i][0], rows[i][1], rows[i][2]};
        pose.translation[static_cast<int>(i)] = rows[i][3];
    }
    return pose;
}

Element primitive_of(const std::string& kind, const Json& size) {
    if (kind == "sphere") {
        return Element::sphere(size[0]);
    }
    if (kind == "ellipsoid") {
        return Element::ellipsoid({size[0], size[1], size[2]});
    }
    if (kind == "box") {
        return Element::box({size[0], size[1], size[2]});
    }
    return kind == "capsule" ? Element::capsule(size[0], size[1]) : Element::cylinder(size[0], size[1]);
}

Mesh mesh_of(const Json& shape, const std::string& file) {
    const Json &numbers = shape["points"], &corners = shape["triangles"];
    Mesh mesh;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        mesh.vertices.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    }
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    if (shape["hull"].get<bool>()) {
        const auto hull = convex_hull(mesh.vertices);
        if (!hull) {
            throw Error(ErrorCode::input, fmt::format("{}: {}: its points span no volume, and it collides as their "
                                                      "hull; remedy: mend the mesh, or remove it",
                                                      file, shown(shape["path"].get<std::string>())));
        }
        return hull->surface;
    }
    return mesh;
}

GeometryElement shape_of(const Json& shape, const std::string& file) {
    GeometryElement element;
    element.name = shape["name"];
    const std::string kind = shape["kind"];
    if (kind == "mesh") {
        const std::string path = shape["path"];
        element.geometry = MeshReference{.uri = path,
                                         .path = {},
                                         .mesh = std::make_shared<const Mesh>(mesh_of(shape, file))};
    } else {
        element.geometry = primitive_of(kind, shape["size"]);
        element.origin = pose_of(shape["pose"]);
    }
    if (shape.contains("rgba")) {
        const Json& rgba = shape["rgba"];
        element.material = std::make_shared<const Material>(
            Material{.name = "", .rgba = std::array<double, 4>{rgba[0], rgba[1], rgba[2], rgba[3]}, .texture = ""});
    }
    return element;
}

Link link_of(const Json& source, const std::string& file) {
    Link link{.name = source["name"], .collisions = {}, .visuals = {}};
    for (const Json& shape : source["collisions"]) {
        link.collisions.push_back(shape_of(shape, file));
    }
    for (const Json& shape : source["visuals"]) {
        link.visuals.push_back(shape_of(shape, file));
    }
    if (const Json& stated = source["inertial"]; !stated.is_null()) {
        Inertial inertial{.mass = stated["mass"].get<double>(), .moments = {}, .origin = pose_of(stated["pose"])};
        if (const Json& moments = stated["moments"]; !moments.is_null()) {
            inertial.moments = std::array<double, 6>{moments[0], moments[1], moments[2], 0, 0, 0};
        }
        link.inertial = inertial;
    }
    return link;
}

Joint::Kind kind_of(const std::string& kind) {
    return kind == "revolute"     ? Joint::Kind::revolute
           : kind == "continuous" ? Joint::Kind::continuous
           : kind == "prismatic"  ? Joint::Kind::prismatic
           : kind == "fixed"      ? Joint::Kind::fixed
                                  : Joint::Kind::floating;
}

Joint joint_of(const Json& source) {
    Joint joint;
    joint.name = source["name"];
    joint.kind = kind_of(source["kind"]);
    joint.parent = source["parent"];
    joint.child = source["child"];
    joint.origin = pose_of(source["pose"]);
    if (source.contains("axis")) {
        const Json& axis = source["axis"];
        joint.axis = normalized(Vec3{axis[0], axis[1], axis[2]});
    }
    joint.limited = source.contains("lower");
    joint.lower = source.value("lower", 0.0);
    joint.upper = source.value("upper", 0.0);
    const auto stated = [&](const char* key) {
        return source.contains(key) ? std::optional(source[key].get<double>()) : std::nullopt;
    };
    joint.effort = stated("effort");
    joint.velocity = stated("velocity");
    return joint;
}

/// Returns what the program prints of the file.
std::string printed(const std::filesystem::path& file) {
    const char* named = std::getenv("FOAM_PYTHON");
    const std::string python = named && *named ? named : "python3";
    ProgramResult done = run_program({python, "-c", program_text, std::filesystem::absolute(file).string()});
    constexpr const char* remedy = "remedy: pip install usd-core, and FOAM_PYTHON=… with the Python that has it";
    if (done.error != 0) {
        throw Error(ErrorCode::plugin, fmt::format("{}: this is USD, which the Python package usd-core reads, and '{}' "
                                                   "cannot be started ({}); {}",
                                                   file.string(), shown(python), std::strerror(done.error), remedy));
    }
    if (done.status == 3) {
        throw Error(ErrorCode::plugin, fmt::format("{}: this is USD, which the Python package usd-core reads, and '{}' "
                                                   "has none:{}\n{}",
                                                   file.string(), shown(python), last_lines(done.errors), remedy));
    }
    if (done.status != 0) {
        throw Error(ErrorCode::input, fmt::format("{}: it cannot be used:{}", file.string(), last_lines(done.errors)));
    }
    return std::move(done.output);
}

std::shared_ptr<const StageOfRobot> stage_of(const Json& told) {
    auto stage = std::make_shared<StageOfRobot>();
    stage->instances = told["instances"];
    stage->default_prim = told["default_prim"];
    stage->up_axis = told["up_axis"];
    stage->metres_per_unit = told["metres_per_unit"];
    for (const Json& link : told["links"]) {
        if (const std::string path = link["path"]; !path.empty()) {
            stage->links[link["name"]] = {.path = path,
                                          .from_metres = link["from_metres"].get<std::array<double, 16>>(),
                                          .colliders = link["colliders"]};
        }
    }
    return stage;
}

} // namespace

Robot robot_of(const std::filesystem::path& file, Context& context) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: a stage of USD is read from its file; remedy: name a file", file.string()));
    }
    const Json told = Json::parse(printed(file));
    for (const auto& [key, severity] : {std::pair{"notes", Severity::info}, std::pair{"warnings", Severity::warning}}) {
        for (const Json& line : told[key]) {
            context.log(severity, fmt::format("{}: {}", file.string(), shown(line.get<std::string>())));
        }
    }
    Robot robot;
    robot.name = told["name"];
    robot.root = told["root"];
    robot.file = file;
    robot.stage = stage_of(told);
    for (const Json& layer : told["layers"]) {
        std::error_code error;
        const std::filesystem::path path = layer.get<std::string>();
        if (!std::filesystem::equivalent(path, file, error)) {
            robot.further_files.push_back(path);
        }
    }
    for (const Json& link : told["links"]) {
        robot.links.push_back(link_of(link, file.string()));
    }
    for (const Json& joint : told["joints"]) {
        robot.joints.push_back(joint_of(joint));
    }
    return robot;
}

} // namespace foam::load_usd
