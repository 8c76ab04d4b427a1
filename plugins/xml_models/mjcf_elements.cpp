// Sizes and places of geoms as MuJoCo's compiler computes them (src/user/user_objects.cc: mjCGeom, mjCOrientation).
#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

#include <numbers>

namespace foam::xml_models {
namespace {

using Kind = Element::Kind;

constexpr std::uintmax_t most_mesh_bytes = 64'000'000;

/// Returns the shortest turn of z to a direction.
Pose turned_z(const Vec3& direction) {
    const Vec3 to = normalized(direction), axis = cross(Vec3{0, 0, 1}, to);
    const double sine = norm(axis);
    if (sine < 1e-10) {
        return to.z < 0 ? Pose::from_axis_angle({1, 0, 0}, std::numbers::pi) : Pose{};
    }
    return Pose::from_axis_angle(axis / sine, std::atan2(sine, to.z));
}

/// Returns the pose whose axes are the columns.
Pose of_axes(const Vec3& x, const Vec3& y) {
    const Vec3 a = normalized(x), b = normalized(y - a * dot(a, y)), c = cross(a, b);
    Pose pose;
    pose.rotation = {Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}};
    return pose;
}

} // namespace

MjcfElements::MjcfElements(const xml::Element& root, const std::filesystem::path& file) : file_(file) {
    for (const xml::Element* compiler : root.children_named("compiler")) {
        const auto take = [&](const char* name, std::string& value) {
            value = compiler->attribute(name) ? *compiler->attribute(name) : value;
        };
        std::string angle = degrees_ ? "degree" : "radian";
        take("angle", angle);
        degrees_ = angle != "radian";
        take("eulerseq", eulerseq_);
        take("assetdir", mesh_folder_);
        take("meshdir", mesh_folder_);
    }
    for (const xml::Element* asset : root.children_named("asset")) {
        for (const xml::Element* mesh : asset->children_named("mesh")) {
            const std::string *name = mesh->attribute("name"), *path = mesh->attribute("file");
            const std::string key = name ? *name : path ? std::filesystem::path(*path).stem().string() : "";
            meshes_[key] = mesh;
        }
    }
}

std::vector<double> MjcfElements::numbers(const MjcfGeom& geom, std::string_view attribute, std::size_t least) const {
    const auto found = geom.stated.find(attribute);
    if (found == geom.stated.end()) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: the {} has no {}", file_.string(), geom.geom->line,
                                                  geom.text("type") ? shown(*geom.text("type")) : "sphere", attribute));
    }
    std::vector<double> values = numbers_of(*found->second, attribute, 0, file_.string());
    if (values.size() < least) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {} of the geom holds {} numbers, not {}", file_.string(),
                                                  geom.geom->line, attribute, values.size(), least));
    }
    return values;
}

Pose MjcfElements::pose_in_frame(const MjcfGeom& geom) const {
    const double unit = degrees_ ? std::numbers::pi / 180 : 1;
    Pose pose;
    // MuJoCo lets a later one of these win over quat, and refuses two of them.
    if (geom.text("axisangle")) {
        const std::vector<double> v = numbers(geom, "axisangle", 4);
        pose = Pose::from_axis_angle(normalized({v[0], v[1], v[2]}), v[3] * unit);
    } else if (geom.text("xyaxes")) {
        const std::vector<double> v = numbers(geom, "xyaxes", 6);
        pose = of_axes({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    } else if (geom.text("zaxis")) {
        const std::vector<double> v = numbers(geom, "zaxis", 3);
        pose = turned_z({v[0], v[1], v[2]});
    } else if (geom.text("euler")) {
        const std::vector<double> v = numbers(geom, "euler", 3);
        for (std::size_t i = 0; i < 3 && i < eulerseq_.size(); ++i) {
            const char letter = eulerseq_[i];
            const char lower = letter < 'a' ? static_cast<char>(letter + 32) : letter;
            const Pose turn = Pose::from_axis_angle(
                {lower == 'x' ? 1.0 : 0.0, lower == 'y' ? 1.0 : 0.0, lower == 'z' ? 1.0 : 0.0}, v[i] * unit);
            pose = lower == letter ? pose * turn : turn * pose; // small letters turn the axes along
        }
    } else if (geom.text("quat")) {
        const std::vector<double> v = numbers(geom, "quat", 4);
        if (v[0] != 0 || v[1] != 0 || v[2] != 0 || v[3] != 0) {
            pose = from_quaternion({}, {v[0], v[1], v[2], v[3]});
        }
    }
    if (geom.text("pos")) {
        const std::vector<double> v = numbers(geom, "pos", 3);
        pose.translation = {v[0], v[1], v[2]};
    }
    return pose;
}

Pose MjcfElements::frame_of(const MjcfGeom& geom) const {
    Pose pose;
    for (const xml::Element* frame : geom.frames) {
        MjcfGeom stated{.geom = frame, .body = geom.body};
        for (const auto& [key, value] : frame->attributes) {
            stated.stated[key] = frame;
        }
        pose = pose * pose_in_frame(stated);
    }
    return pose;
}

std::optional<Element> MjcfElements::element_of(const MjcfGeom& geom, std::string& why) const {
    if (geom.replicated) {
        why = "copied by <replicate>";
        return {};
    }
    auto element = element_in_frame(geom, why);
    if (element && !geom.frames.empty()) {
        element->pose = frame_of(geom) * element->pose;
    }
    return element;
}

/// Returns the element between two points that `fromto` states.
std::optional<Element> MjcfElements::between(const MjcfGeom& geom, Element element) const {
    const std::vector<double> v = numbers(geom, "fromto", 6);
    const Vec3 from{v[0], v[1], v[2]}, to{v[3], v[4], v[5]};
    element.pose = turned_z(from - to); // as MuJoCo does; it matters for a box
    element.pose.translation = (from + to) * 0.5;
    element.half.z = norm(to - from) / 2;
    return element;
}

std::optional<Element> MjcfElements::element_in_frame(const MjcfGeom& geom, std::string& why) const {
    const std::string* given = geom.text("type");
    const std::string type = given ? *given : geom.geom->attribute("mesh") ? "mesh" : "sphere";
    if (type == "mesh") {
        const std::string* mesh = geom.text("mesh");
        auto element = mesh ? hull_of_mesh(*mesh, why) : std::nullopt;
        if (element) {
            const Pose place = pose_in_frame(geom);
            element->pose = place;
        }
        return element;
    }
    if (geom.text("mesh")) {
        why = "fitted to a mesh";
        return {};
    }
    if (type == "sphere") {
        return Element{.kind = Kind::sphere,
                       .pose = {.translation = pose_in_frame(geom).translation},
                       .radius = numbers(geom, "size", 1)[0]};
    }
    const bool is_capsule = type == "capsule";
    if (is_capsule || type == "cylinder") {
        Element element{.kind = is_capsule ? Kind::capsule : Kind::cylinder, .radius = numbers(geom, "size", 1)[0]};
        if (geom.text("fromto")) {
            return between(geom, element);
        }
        element.half.z = numbers(geom, "size", 2)[1];
        element.pose = pose_in_frame(geom);
        return element;
    }
    if (type == "box" || type == "ellipsoid") {
        Element element{.kind = type == "box" ? Kind::box : Kind::ellipsoid};
        if (geom.text("fromto")) { // as wide as it is high
            element.half.x = element.half.y = numbers(geom, "size", 1)[0];
            return between(geom, element);
        }
        const std::vector<double> half = numbers(geom, "size", 3);
        element.half = {half[0], half[1], half[2]};
        element.pose = pose_in_frame(geom);
        return element;
    }
    why = shown(type);
    return {};
}

std::optional<Element> MjcfElements::hull_of_mesh(const std::string& name, std::string& why) const {
    const auto found = meshes_.find(name);
    why = fmt::format("mesh '{}'", shown(name));
    if (found == meshes_.end() || found->second->attribute("refpos") || found->second->attribute("refquat") ||
        found->second->attribute("class")) {
        return {};
    }
    const xml::Element& mesh = *found->second;
    std::vector<Vec3> corners;
    try {
        if (mesh.attribute("vertex")) {
            const std::vector<double> v = numbers_of(mesh, "vertex", 0, file_.string());
            for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
                corners.push_back({v[i], v[i + 1], v[i + 2]});
            }
        } else if (const std::string* path = mesh.attribute("file")) {
            corners = corners_of(
                read_regular_file(file_.parent_path() / mesh_folder_ / *path, most_mesh_bytes, "leave it out").bytes);
        }
        if (mesh.attribute("scale")) {
            const std::vector<double> s = numbers_of(mesh, "scale", 3, file_.string());
            for (Vec3& p : corners) {
                p = {p.x * s[0], p.y * s[1], p.z * s[2]};
            }
        }
        Element element{.kind = Kind::hull};
        element.hull = convex_hull(corners);
        return element;
    } catch (const Error&) { // a file that is missing or no OBJ or STL, corners in a plane: the note names the mesh
        return {};
    }
}

} // namespace foam::xml_models
