#include "scene.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace foam::scene {
namespace {

using yaml::Value;
using Kind = Value::Kind;

constexpr int cube_type = 1, sphere_type = 2, cylinder_type = 3, triangles_type = 11; // visualization_msgs/Marker
constexpr yaml::TextKind marker_file{.name = "marker file", .most_bytes = 64'000'000};

/// Colours that differ for people with any vision (Okabe and Ito 2008).
constexpr std::array<std::array<double, 3>, 6> colours{
    {{0.0, 0.45, 0.7}, {0.9, 0.6, 0.0}, {0.0, 0.6, 0.5}, {0.8, 0.4, 0.0}, {0.35, 0.7, 0.9}, {0.8, 0.6, 0.7}}};

Value vector_value(const Vec3& v) {
    return yaml::map({{"x", yaml::real(v.x)}, {"y", yaml::real(v.y)}, {"z", yaml::real(v.z)}});
}

Value colour_value(std::size_t link, double alpha) {
    const auto& [r, g, b] = colours[link % colours.size()];
    return yaml::map({{"r", yaml::real(r)}, {"g", yaml::real(g)}, {"b", yaml::real(b)}, {"a", yaml::real(alpha)}});
}

/// A marker of a link. `xyzw`: its rotation.
struct Shape {
    int type = sphere_type;
    Vec3 position, scale;
    std::array<double, 4> xyzw{0, 0, 0, 1};
};

Value marker_value(const std::string& link, std::int64_t id, const Shape& shape, const Value& colour) {
    if (!is_finite(shape.scale)) {
        throw Error(ErrorCode::output, fmt::format("sphere {} of link '{}': the diameter exceeds a double; remedy: a "
                                                   "smaller sphere",
                                                   id, shown(link)));
    }
    const auto& [x, y, z, w] = shape.xyzw;
    const Value turned =
        yaml::map({{"x", yaml::real(x)}, {"y", yaml::real(y)}, {"z", yaml::real(z)}, {"w", yaml::real(w)}});
    return yaml::map({{"header", yaml::map({{"frame_id", yaml::text(link)}})},
                      {"ns", yaml::text(link)},
                      {"id", yaml::integer(id)},
                      {"type", yaml::integer(shape.type)},
                      {"action", yaml::integer(0)},
                      {"pose", yaml::map({{"position", vector_value(shape.position)}, {"orientation", turned}})},
                      {"scale", vector_value(shape.scale)},
                      {"color", colour},
                      {"frame_locked", yaml::boolean(true)}});
}

Value marker_value(const std::string& link, std::int64_t id, const Sphere& s, const Value& colour) {
    const double diameter = 2 * s.radius;
    return marker_value(link, id, Shape{sphere_type, s.center, {diameter, diameter, diameter}}, colour);
}

/// Returns the marker of a box, a cylinder or a hull.
Value marker_value(const std::string& link, std::int64_t id, const Element& element, const Value& colour) {
    if (element.kind == Element::Kind::hull) {
        Value marker = marker_value(link, id, Shape{triangles_type, element.pose.translation, {1, 1, 1}}, colour);
        Value points = yaml::list();
        for (const Triangle& triangle : element.hull->surface.triangles) {
            for (const std::uint32_t corner : triangle) {
                points.items.push_back(vector_value(element.hull->surface.vertices[corner]));
            }
        }
        yaml::append(marker, "points", std::move(points));
        return marker;
    }
    const auto [x, y, z, w] = message_quaternion(element.pose);
    const Element stated = stated_at(element, from_quaternion(element.pose.translation, {w, x, y, z}));
    const Vec3 half =
        stated.kind == Element::Kind::box ? stated.half : Vec3{stated.radius, stated.radius, stated.half.z};
    return marker_value(link, id,
                        Shape{stated.kind == Element::Kind::box ? cube_type : cylinder_type,
                              stated.pose.translation,
                              half * 2,
                              {x, y, z, w}},
                        colour);
}

/// Reads the values of a message, with places for errors.
class Message {
public:
    explicit Message(const std::filesystem::path& file)
        : result{.file = file, .format = "ROS markers", .links = {}, .fixed_joints = {}, .notes = {}} {}

    void add(const Value& marker) {
        const double type = number(at(marker, "type"));
        const Value* action = marker.find("action");
        const Value& scale = at(marker, "scale");
        const Vec3 size = point(scale);
        const bool known = type == sphere_type || type == cylinder_type || type == cube_type || type == triangles_type;
        if (!known || (action && number(*action) != 0) || (type == cylinder_type && size.x != size.y)) {
            ++left_out_;
            return;
        }
        const Value& frame = at(at(marker, "header"), "frame_id");
        if (!frame.is_scalar() || frame.text.empty()) {
            fail(frame, "expected the name of a frame, got " + frame.description());
        }
        const Pose pose = pose_of(marker.find("pose"));
        std::shared_ptr<const Polytope> hull;
        if (type == triangles_type && !(hull = hull_of(at(marker, "points"), size))) {
            ++left_out_; // the triangles are no convex surface: they enclose less than their hull
            return;
        }
        LinkSpheres& link = link_of(result, frame.text);
        if (type == sphere_type && size.x == size.y && size.x == size.z) {
            link.elements.add(Sphere{pose.translation, size.x / 2});
            return;
        }
        Element element{.pose = pose};
        if (type == triangles_type) {
            element.kind = Element::Kind::hull;
            element.hull = hull;
        } else if (type == cube_type || type == sphere_type) { // with three diameters it is an ellipsoid
            element.kind = type == cube_type ? Element::Kind::box : Element::Kind::ellipsoid;
            element.half = size * 0.5;
        } else {
            element.kind = Element::Kind::cylinder;
            element.half.z = size.z / 2;
            element.radius = size.x / 2;
        }
        link.elements.add(std::move(element));
    }

    const Value& list(const Value& value) const {
        if (!value.is(Kind::list)) {
            fail(value, "expected a list of markers, got " + value.description());
        }
        return value;
    }

    const Value& at(const Value& map, std::string_view key) const {
        const Value* value = map.is(Kind::map) ? map.find(key) : nullptr;
        if (!value) {
            fail(map, fmt::format("expected a map with the key '{}', got {}", key,
                                  map.is(Kind::map) ? "one without" : map.description()));
        }
        return *value;
    }

    void finish() {
        if (left_out_ > 0) {
            result.notes.push_back(fmt::format("{} marker{} no single convex element{}, and left out", left_out_,
                                               left_out_ == 1 ? " is" : "s are", left_out_ == 1 ? "" : "s"));
        }
    }

    SphereFile result;

private:
    [[noreturn]] void fail(const Value& at, const std::string& why) const {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}:{}: {}", result.file.string(), at.where.line, at.where.column, shown(why)));
    }

    double number(const Value& value) const {
        const bool whole = value.is(Kind::integer);
        const double number = whole ? static_cast<double>(value.whole) : value.real;
        if ((!whole && !value.is(Kind::number)) || !std::isfinite(number)) {
            fail(value, "expected a finite number, got " + value.description());
        }
        return number;
    }

    Vec3 point(const Value& value) const {
        return {number(at(value, "x")), number(at(value, "y")), number(at(value, "z"))};
    }

    /// `pose`: null has the default of the message, the frame's own.
    Pose pose_of(const Value* pose) const {
        if (!pose) {
            return {};
        }
        const Value* turned = pose->find("orientation");
        const Vec3 place = point(at(*pose, "position"));
        if (!turned) {
            return Pose{.translation = place};
        }
        const auto part = [&](const char* name, double otherwise) {
            const Value* value = turned->find(name); // what a message leaves out has its default
            return value ? number(*value) : otherwise;
        };
        const std::array<double, 4> wxyz{part("w", 1), part("x", 0), part("y", 0), part("z", 0)};
        return wxyz == std::array<double, 4>{} ? Pose{.translation = place} // as RViz takes it
                                               : from_quaternion(place, wxyz);
    }

    /// Returns the hull of a list of triangles, three points each; nothing if they are not its whole surface.
    std::shared_ptr<const Polytope> hull_of(const Value& points, const Vec3& scale) const {
        Mesh mesh;
        for (const Value& value : list(points).items) {
            const Vec3 p = point(value);
            mesh.vertices.push_back({p.x * scale.x, p.y * scale.y, p.z * scale.z});
        }
        if (mesh.vertices.empty() || mesh.vertices.size() % 3 != 0) {
            fail(points, fmt::format("expected three points for each triangle, got {} points", mesh.vertices.size()));
        }
        for (std::uint32_t i = 0; i < mesh.vertices.size(); i += 3) {
            mesh.triangles.push_back({i, i + 1, i + 2});
        }
        return hull_if_convex(mesh);
    }

    std::size_t left_out_ = 0;
};

} // namespace

std::string markers_text(const SphereModel& model, double alpha) {
    Value markers = yaml::list();
    std::size_t number = 0;
    for (const LinkSpheres& link : in_known_kinds(elements_by_link(model), {.capsules = false})) {
        if (link.link.empty()) {
            throw Error(ErrorCode::output, "a link without a name is no frame of ROS; remedy: name the link");
        }
        const Value colour = colour_value(number++, alpha);
        CancellationCounter asking(1024);
        std::int64_t id = 0;
        for (const Sphere& sphere : link.elements.spheres()) {
            asking.check();
            markers.items.push_back(marker_value(link.link, id++, sphere, colour));
        }
        for (const Element& element : link.elements.shaped()) {
            asking.check();
            markers.items.push_back(marker_value(link.link, id++, element, colour));
        }
    }
    return (model.provenance.empty() ? "" : "# " + shown(model.provenance) + "\n") +
           yaml::block_text(yaml::map({{"markers", std::move(markers)}}));
}

bool is_markers(std::string_view text) {
    text.remove_prefix(text.starts_with("---\n") ? 4 : 0);
    if (text.starts_with('{')) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n", 1), text.size()));
        text.remove_prefix(text.starts_with('"') ? 1 : 0);
    }
    return (text.starts_with("markers:") || text.starts_with("markers\"")) && text.find("frame_id") != text.npos;
}

SphereFile read_markers(const std::string& text, const std::filesystem::path& file) {
    const Value root = yaml::tree_of(text, file.string(), marker_file);
    Message message(file);
    for (const Value& marker : message.list(message.at(root, "markers")).items) {
        message.add(marker);
    }
    message.finish();
    return std::move(message.result);
}

} // namespace foam::scene
