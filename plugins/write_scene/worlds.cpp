#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::scene {
namespace {

constexpr yaml::TextKind world_file{.name = "world file", .most_bytes = 64'000'000};

yaml::Value point_list(const Vec3& p) {
    return yaml::list({p.x, p.y, p.z});
}

/// Throws for a model of several links: the files have obstacles of one frame.
const LinkSpheres& only_link(const std::vector<LinkSpheres>& links, std::string_view writer) {
    if (links.size() != 1) {
        throw Error(ErrorCode::output, fmt::format("{} writes obstacles of one frame, the model has {} links; remedy: "
                                                   "write.moveit_scene, which has poses of links",
                                                   writer, links.size()));
    }
    return links.front();
}

/// The name of the element of a number: "cup_3". Its link is what is before the last '_'.
std::string name_of(const LinkSpheres& link, std::size_t number) {
    return link.link + '_' + std::to_string(number);
}

/// x, y, z, qw, qx, qy, qz
yaml::Value curobo_pose(const Pose& pose) {
    const auto [w, x, y, z] = foam::quaternion(pose);
    const Vec3& p = pose.translation;
    return yaml::list({p.x, p.y, p.z, w, x, y, z});
}

/// Reads obstacles with places for errors.
class Obstacles {
public:
    Obstacles(const std::filesystem::path& file, std::string format)
        : result{.file = file, .format = std::move(format), .links = {}, .fixed_joints = {}, .notes = {}} {}

    yaml::Value parse(const std::string& text) const {
        return yaml::tree_of(text, result.file.string(), world_file);
    }

    [[noreturn]] void fail(const yaml::Value& at, const std::string& why) const {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}:{}: {}", result.file.string(), at.where.line, at.where.column, shown(why)));
    }

    const yaml::Value& at(const yaml::Value& map, std::string_view key) const {
        const yaml::Value* value = map.is(yaml::Value::Kind::map) ? map.find(key) : nullptr;
        if (!value) {
            fail(map, fmt::format("expected an obstacle with the key '{}'", key));
        }
        return *value;
    }

    double number(const yaml::Value& value) const {
        const bool whole = value.is(yaml::Value::Kind::integer);
        const double number = whole ? static_cast<double>(value.whole) : value.real;
        if ((!whole && !value.is(yaml::Value::Kind::number)) || !std::isfinite(number)) {
            fail(value, "expected a finite number, got " + value.description());
        }
        return number;
    }

    template <std::size_t count> std::array<double, count> numbers(const yaml::Value& value) const {
        if (!value.is(yaml::Value::Kind::list) || value.items.size() != count) {
            fail(value, fmt::format("expected a list of {} numbers, got {}", count, value.description()));
        }
        std::array<double, count> result{};
        for (std::size_t i = 0; i < count; ++i) {
            result[i] = number(value.items[i]);
        }
        return result;
    }

    Vec3 point(const yaml::Value& value) const {
        const auto [x, y, z] = numbers<3>(value);
        return {x, y, z};
    }

    void add(const std::string& name, const Element& element) {
        const std::size_t end = name.rfind('_');
        link_of(result, end == name.npos ? name : name.substr(0, end)).elements.add(element);
    }

    SphereFile result;
};

Pose read_curobo_pose(const Obstacles& reader, const yaml::Value& obstacle) {
    const auto v = reader.numbers<7>(reader.at(obstacle, "pose"));
    if (v[3] == 0 && v[4] == 0 && v[5] == 0 && v[6] == 0) {
        reader.fail(obstacle, "a quaternion of zeros is no rotation");
    }
    return from_quaternion({v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]});
}

Element read_curobo_mesh(const Obstacles& reader, const yaml::Value& obstacle) {
    Mesh mesh;
    const yaml::Value &vertices = reader.at(obstacle, "vertices"), &faces = reader.at(obstacle, "faces");
    for (const yaml::Value& vertex : vertices.items) {
        mesh.vertices.push_back(reader.point(vertex));
    }
    for (const yaml::Value& face : faces.items) {
        Triangle triangle{};
        const auto corners = reader.numbers<3>(face);
        for (std::size_t i = 0; i < 3; ++i) {
            if (!(corners[i] >= 0 && corners[i] < static_cast<double>(mesh.vertices.size()))) {
                reader.fail(face, "a face has a corner that is no vertex");
            }
            triangle[i] = static_cast<std::uint32_t>(corners[i]);
        }
        mesh.triangles.push_back(triangle);
    }
    Element element{.kind = Element::Kind::hull, .pose = read_curobo_pose(reader, obstacle)};
    element.hull = hull_if_convex(mesh);
    return element;
}

} // namespace

std::string curobo_scene_text(const SphereModel& model, int segments) {
    const std::vector<LinkSpheres> links = elements_by_link(model);
    const LinkSpheres& link = only_link(links, "write.curobo_scene");
    yaml::Value spheres = yaml::map(), cuboids = yaml::map(), meshes = yaml::map();
    std::size_t number = 0;
    const auto add = [&](const Element& element) {
        const std::string name = name_of(link, number++);
        if (element.kind == Element::Kind::box) {
            const Element stated =
                stated_at(element, from_quaternion(element.pose.translation, foam::quaternion(element.pose)));
            yaml::append(cuboids, name,
                         yaml::map({{"dims", point_list(stated.half * 2)}, {"pose", curobo_pose(element.pose)}}));
            return;
        }
        const Element hull = float32_hull(enclosing_hull(element, segments));
        yaml::Value vertices = yaml::list(), faces = yaml::list();
        for (const Vec3& p : hull.hull->surface.vertices) {
            vertices.items.push_back(point_list(p));
        }
        for (const auto& [a, b, c] : hull.hull->surface.triangles) {
            faces.items.push_back(yaml::list({yaml::integer(a), yaml::integer(b), yaml::integer(c)}));
        }
        yaml::append(
            meshes, name,
            yaml::map(
                {{"vertices", std::move(vertices)}, {"faces", std::move(faces)}, {"pose", curobo_pose(hull.pose)}}));
    };
    for (const Sphere& s : link.elements.spheres()) {
        yaml::append(spheres, name_of(link, number++),
                     yaml::map({{"radius", yaml::real(s.radius)}, {"pose", curobo_pose({.translation = s.center})}}));
    }
    for (const Element& element : link.elements.shaped()) {
        add(element);
    }
    yaml::Value root = yaml::map();
    if (!spheres.keys.empty()) {
        yaml::append(root, "sphere", std::move(spheres));
    }
    if (!cuboids.keys.empty()) {
        yaml::append(root, "cuboid", std::move(cuboids));
    }
    if (!meshes.keys.empty()) {
        yaml::append(root, "mesh", std::move(meshes));
    }
    return (model.provenance.empty() ? "" : "# " + shown(model.provenance) + "\n") + yaml::block_text(root);
}

bool is_curobo_scene(std::string_view text) {
    for (const char* key : {"sphere:", "cuboid:", "mesh:", "capsule:", "cylinder:"}) {
        if (text.starts_with(key)) {
            return text.find("pose:") != text.npos || text.find("position:") != text.npos;
        }
    }
    return false;
}

SphereFile read_curobo_scene(const std::string& text, const std::filesystem::path& file) {
    Obstacles reader(file, "cuRobo scene");
    const yaml::Value root = reader.parse(text);
    std::size_t left_out = 0;
    for (std::size_t kind = 0; kind < root.keys.size(); ++kind) {
        const yaml::Value& obstacles = root.items[kind];
        for (std::size_t i = 0; i < obstacles.keys.size(); ++i) {
            const std::string& name = obstacles.keys[i].text;
            const yaml::Value& obstacle = obstacles.items[i];
            if (root.keys[kind].text == "sphere") {
                const yaml::Value* position = obstacle.find("position"); // the word of 0.7
                const Pose pose =
                    position ? Pose{.translation = reader.point(*position)} : read_curobo_pose(reader, obstacle);
                reader.add(name, {.pose = pose, .radius = reader.number(reader.at(obstacle, "radius"))});
            } else if (root.keys[kind].text == "cuboid") {
                reader.add(name, {.kind = Element::Kind::box,
                                  .pose = read_curobo_pose(reader, obstacle),
                                  .half = reader.point(reader.at(obstacle, "dims")) * 0.5});
            } else if (root.keys[kind].text == "mesh" && obstacle.find("vertices")) {
                const Element element = read_curobo_mesh(reader, obstacle);
                element.hull ? reader.add(name, element) : void(++left_out);
            } else {
                ++left_out; // of a capsule or cylinder cuRobo makes a mesh that lies inside it
            }
        }
    }
    if (reader.result.links.empty()) {
        reader.fail(root, "there is neither a sphere, a cuboid nor a convex mesh with its vertices");
    }
    if (left_out > 0) {
        reader.result.notes.push_back(fmt::format("{} obstacle{} neither a sphere, a cuboid nor a convex mesh with its "
                                                  "vertices, and left out",
                                                  left_out, left_out == 1 ? " is" : "s are"));
    }
    return std::move(reader.result);
}

std::string vamp_world_text(const SphereModel& model) {
    const std::vector<LinkSpheres> links = elements_by_link(model);
    const LinkSpheres& link = only_link(links, "write.vamp_world");
    yaml::Value spheres = yaml::list(), cylinders = yaml::list(), boxes = yaml::list();
    std::size_t number = 0;
    for (const Sphere& s : link.elements.spheres()) {
        spheres.items.push_back(yaml::map({{"name", yaml::text(name_of(link, number++))},
                                           {"position", point_list(s.center)},
                                           {"radius", yaml::real(s.radius)}}));
    }
    for (const Element& element : link.elements.shaped()) {
        const std::string name = name_of(link, number++);
        const bool is_box = element.kind == Element::Kind::box;
        if (!is_box && element.kind != Element::Kind::capsule && element.kind != Element::Kind::cylinder) {
            throw Error(ErrorCode::output,
                        fmt::format("write.vamp_world: VAMP's problems hold spheres, capsules, cylinders and boxes, "
                                    "but no {}; remedy: other kinds of elements",
                                    noun_of(element.kind, 2)));
        }
        // Roll, pitch and yaw, as in a URDF.
        const Vec3 rpy = short_roll_pitch_yaw(element.pose);
        const Element stated = stated_at(element, Pose::from_xyz_rpy(element.pose.translation, rpy));
        yaml::Value obstacle = yaml::map({{"name", yaml::text(name)},
                                          {"position", point_list(stated.pose.translation)},
                                          {"orientation_euler_xyz", point_list(rpy)}});
        if (is_box) {
            yaml::append(obstacle, "half_extents", point_list(stated.half));
            boxes.items.push_back(std::move(obstacle));
        } else {
            yaml::append(obstacle, "radius", yaml::real(stated.radius));
            yaml::append(obstacle, "length", yaml::real(2 * stated.half.z));
            cylinders.items.push_back(std::move(obstacle));
        }
    }
    return yaml::json_text(yaml::map({{"sphere", std::move(spheres)},
                                      {"cylinder", std::move(cylinders)},
                                      {"box", std::move(boxes)},
                                      {"problem", yaml::text("")}})); // "box" would turn capsules to boxes
}

bool is_vamp_world(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n", text.starts_with('{') ? 1 : 0);
    return text.starts_with('{') && first != text.npos && text.substr(first).starts_with("\"sphere\"") &&
           text.find("\"cylinder\"") != text.npos && text.find("\"box\"") != text.npos;
}

SphereFile read_vamp_world(const std::string& text, const std::filesystem::path& file) {
    Obstacles reader(file, "VAMP world");
    const yaml::Value root = reader.parse(text);
    const yaml::Value* problem = root.is(yaml::Value::Kind::map) ? root.find("problem") : nullptr;
    if (problem && problem->text == "box") {
        reader.fail(*problem,
                    "VAMP turns the capsules of the problem 'box' to boxes that leave their caps out; remedy: "
                    "another name");
    }
    const auto each = [&](const char* kind, const auto& read) {
        const yaml::Value& obstacles = reader.at(root, kind);
        for (const yaml::Value& obstacle : obstacles.items) {
            Element element = read(obstacle);
            const Vec3 place = reader.point(reader.at(obstacle, "position"));
            const yaml::Value* turned = obstacle.find("orientation_euler_xyz");
            element.pose = Pose::from_xyz_rpy(place, turned ? reader.point(*turned) : Vec3{});
            const yaml::Value* name = obstacle.find("name");
            reader.add(name ? name->text : "", element);
        }
    };
    each("sphere", [&](const yaml::Value& o) { return Element{.radius = reader.number(reader.at(o, "radius"))}; });
    each("cylinder", [&](const yaml::Value& o) {
        return Element{.kind = Element::Kind::capsule,
                       .half = {0, 0, reader.number(reader.at(o, "length")) / 2},
                       .radius = reader.number(reader.at(o, "radius"))};
    });
    each("box", [&](const yaml::Value& o) {
        return Element{.kind = Element::Kind::box, .half = reader.point(reader.at(o, "half_extents"))};
    });
    return std::move(reader.result);
}

} // namespace foam::scene
