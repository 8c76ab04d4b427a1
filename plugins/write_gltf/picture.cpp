#include "picture.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/inscribed_mesh.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <map>

namespace foam::gltf {
namespace {

using yaml::Value;

// Numbers that glTF gives to kinds of data.
constexpr int array_buffer = 34962, element_buffer = 34963, type_float = 5126, type_uint16 = 5123, type_uint32 = 5125;

Value whole(std::size_t number) {
    return yaml::integer(static_cast<std::int64_t>(number));
}

Value point(const Vec3& p) {
    return yaml::list({p.x, p.y, p.z});
}

/// Throws for a name that is not UTF-8 or has control characters: readers of JSON differ on these.
void require_name(const std::string& link) {
    yaml::Findings findings("");
    if (!yaml::check_text(link, 0, findings)) {
        throw Error(ErrorCode::output, fmt::format("link '{}': a glTF holds no name that is not UTF-8 or has control "
                                                   "characters; remedy: rename the link",
                                                   shown(link)));
    }
}

/// Returns a pose as glTF has it: the columns of a 4 × 4 matrix.
Value matrix(const Pose& pose) {
    const auto& [a, b, c] = pose.rotation;
    const Vec3& t = pose.translation;
    return yaml::list({a.x, b.x, c.x, 0.0, a.y, b.y, c.y, 0.0, a.z, b.z, c.z, 0.0, t.x, t.y, t.z, 1.0});
}

Value sphere_node(const Sphere& s) {
    return yaml::map({{"mesh", yaml::integer(0)},
                      {"translation", point(s.center)},
                      {"scale", point({s.radius, s.radius, s.radius})},
                      {"extras", yaml::map({{"radius", yaml::real(s.radius)}})}});
}

/// Returns the node of an element that is no sphere, whose mesh is in the link's frame.
Value element_node(const Element& element, std::size_t mesh) {
    Value numbers = yaml::map({{"kind", yaml::text(to_string(element.kind))}});
    for (const auto& [name, values] : numbers_of(element)) {
        Value list = yaml::list();
        for (const double value : values) {
            list.items.push_back(yaml::real(value));
        }
        yaml::append(numbers, name, std::move(list));
    }
    return yaml::map({{"mesh", whole(mesh)}, {"extras", yaml::map({{"element", std::move(numbers)}})}});
}

/// Returns the nodes: the root, the links, the elements.
Value nodes_of(const std::vector<LinkSpheres>& links, const std::map<std::string, Pose>& poses) {
    Value link_numbers = yaml::list(), link_nodes = yaml::list(), sphere_nodes = yaml::list();
    const std::size_t first_sphere = 1 + links.size();
    std::size_t meshes = 0;
    for (const LinkSpheres& link : links) {
        require_name(link.link);
        Value children = yaml::list();
        CancellationCounter asking(1024);
        for (const Sphere& s : link.elements.spheres()) {
            asking.check();
            children.items.push_back(whole(first_sphere + sphere_nodes.items.size()));
            sphere_nodes.items.push_back(sphere_node(s));
        }
        for (const Element& element : link.elements.shaped()) {
            asking.check();
            children.items.push_back(whole(first_sphere + sphere_nodes.items.size()));
            sphere_nodes.items.push_back(element_node(element, ++meshes)); // 0 is the sphere
        }
        Value node = yaml::map({{"name", yaml::text(link.link)}});
        const auto pose = poses.find(link.link);
        if (pose != poses.end() && pose->second != Pose{}) {
            yaml::append(node, "matrix", matrix(pose->second));
        }
        yaml::append(node, "children", std::move(children));
        link_numbers.items.push_back(whole(1 + link_nodes.items.size()));
        link_nodes.items.push_back(std::move(node));
    }
    const double half = std::sqrt(0.5); // robots have z up, glTF y: a turn of -90° about x
    Value root = yaml::map({{"name", yaml::text("z_up")}, {"rotation", yaml::list({-half, 0.0, 0.0, half})}});
    if (!links.empty()) {
        yaml::append(root, "children", std::move(link_numbers));
    }
    Value nodes = yaml::list();
    nodes.items.push_back(std::move(root));
    for (Value* more : {&link_nodes, &sphere_nodes}) {
        std::move(more->items.begin(), more->items.end(), std::back_inserter(nodes.items));
    }
    return nodes;
}

Value accessor(int view, int type, std::size_t count, const std::string& kind) {
    return yaml::map({{"bufferView", yaml::integer(view)},
                      {"componentType", yaml::integer(type)},
                      {"count", whole(count)},
                      {"type", yaml::text(kind)}});
}

Value view(std::size_t offset, std::size_t length, int target) {
    return yaml::map({{"buffer", yaml::integer(0)},
                      {"byteOffset", whole(offset)},
                      {"byteLength", whole(length)},
                      {"target", yaml::integer(target)}});
}

/// Returns the accessor of corners, with their bounds as the numbers are in the buffer.
Value positions_of(const Mesh& mesh, int view) {
    Vec3 low{1, 1, 1}, high{-1, -1, -1};
    if (view > 0) { // the unit sphere is the first
        low = Vec3{1, 1, 1} * std::numeric_limits<double>::infinity();
        high = -low;
    }
    for (const Vec3& p : mesh.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            const double x = static_cast<double>(static_cast<float>(p[axis]));
            low[axis] = std::min(low[axis], x);
            high[axis] = std::max(high[axis], x);
        }
    }
    Value positions = accessor(view, type_float, mesh.vertices.size(), "VEC3");
    yaml::append(positions, "min", point(low));
    yaml::append(positions, "max", point(high));
    return positions;
}

void add_bytes(std::string& bytes, std::uint32_t number, int count) {
    for (int i = 0; i < count; ++i) {
        bytes += static_cast<char>(number >> (8 * i) & 0xFFU);
    }
}

/// Returns the corners in single precision, little-endian.
std::string corner_bytes(const Mesh& mesh) {
    std::string bytes;
    for (const Vec3& p : mesh.vertices) {
        for (const double x : {p.x, p.y, p.z}) {
            add_bytes(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)), 4);
        }
    }
    return bytes;
}

/// Returns the triangles' corners as numbers of `size` bytes, little-endian.
std::string index_bytes(const Mesh& mesh, int size) {
    std::string bytes;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            add_bytes(bytes, corner, size);
        }
    }
    return bytes;
}

/// Meshes with their accessors, views and bytes in one buffer.
struct Meshes {
    Value meshes = yaml::list(), accessors = yaml::list(), views = yaml::list();
    std::string bytes;

    /// Adds the mesh of all spheres, whose corners are its normals.
    void add_sphere(const Mesh& mesh) {
        bytes = corner_bytes(mesh) + index_bytes(mesh, 2);
        const std::size_t corners = 12 * mesh.vertices.size();
        accessors = yaml::list({positions_of(mesh, 0), accessor(0, type_float, mesh.vertices.size(), "VEC3"),
                                accessor(1, type_uint16, 3 * mesh.triangles.size(), "SCALAR")});
        views = yaml::list({yaml::map({{"buffer", yaml::integer(0)},
                                       {"byteLength", whole(corners)},
                                       {"byteStride", yaml::integer(12)}, // needed where two accessors share bytes
                                       {"target", yaml::integer(array_buffer)}}),
                            view(corners, bytes.size() - corners, element_buffer)});
        add_mesh("sphere", yaml::map({{"POSITION", yaml::integer(0)}, {"NORMAL", yaml::integer(1)}}), 2);
    }

    /// Adds the mesh of an element. Without normals it is shown with flat sides.
    void add_element(const Element& element) {
        const Mesh mesh = enclosing_mesh(element, 24);
        const std::size_t first = accessors.items.size(), corners = bytes.size();
        bytes += corner_bytes(mesh);
        const std::size_t indices = bytes.size();
        bytes += index_bytes(mesh, 4);
        const int corner_view = static_cast<int>(views.items.size());
        accessors.items.push_back(positions_of(mesh, corner_view));
        accessors.items.push_back(accessor(corner_view + 1, type_uint32, 3 * mesh.triangles.size(), "SCALAR"));
        views.items.push_back(view(corners, indices - corners, array_buffer));
        views.items.push_back(view(indices, bytes.size() - indices, element_buffer));
        add_mesh(to_string(element.kind), yaml::map({{"POSITION", whole(first)}}), first + 1);
    }

private:
    void add_mesh(const char* name, Value attributes, std::size_t indices) {
        meshes.items.push_back(yaml::map({{"name", yaml::text(name)},
                                          {"primitives", yaml::list({yaml::map({{"attributes", std::move(attributes)},
                                                                                {"indices", whole(indices)},
                                                                                {"material", yaml::integer(0)}})})}}));
    }
};

/// Adds the meshes of the elements and their bytes.
void append_meshes(Value& root, const std::vector<LinkSpheres>& links) {
    Meshes meshes;
    meshes.add_sphere(icosphere(2)); // 320 triangles look round at the size of a robot link
    for (const LinkSpheres& link : links) {
        for (const Element& element : link.elements.shaped()) {
            meshes.add_element(element);
        }
    }
    const Value colour = yaml::map({{"baseColorFactor", yaml::list({0.2, 0.5, 0.8, 1.0})},
                                    {"metallicFactor", yaml::real(0)},
                                    {"roughnessFactor", yaml::real(0.7)}});
    yaml::append(root, "meshes", std::move(meshes.meshes));
    yaml::append(root, "materials", yaml::list({yaml::map({{"pbrMetallicRoughness", colour}})}));
    yaml::append(root, "accessors", std::move(meshes.accessors));
    yaml::append(root, "bufferViews", std::move(meshes.views));
    const std::string uri = "data:application/octet-stream;base64," + base64(meshes.bytes);
    yaml::append(root, "buffers",
                 yaml::list({yaml::map({{"byteLength", whole(meshes.bytes.size())}, {"uri", yaml::text(uri)}})}));
}

} // namespace

std::string picture_text(const SphereModel& model) {
    const std::vector<LinkSpheres> links = elements_by_link(model);
    Value extras = yaml::map({{"note", yaml::text("for pictures only: the triangles lie inside of the spheres; "
                                                  "extras.radius of nodes and their translation are exact")}});
    if (!model.provenance.empty()) {
        yaml::append(extras, "provenance", yaml::text(shown(model.provenance))); // JSON has no comments
    }
    Value root = yaml::map({{"asset", yaml::map({{"version", yaml::text("2.0")},
                                                 {"generator", yaml::text("foam write.gltf, for pictures only")},
                                                 {"extras", std::move(extras)}})},
                            {"scene", yaml::integer(0)},
                            {"scenes", yaml::list({yaml::map({{"nodes", yaml::list({yaml::integer(0)})}})})},
                            {"nodes", nodes_of(links, placed_links(model))}});
    append_meshes(root, links);
    return yaml::json_text(root);
}

} // namespace foam::gltf
