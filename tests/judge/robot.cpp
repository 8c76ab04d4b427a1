#include "robot.hpp"

#include "mesh_files.hpp"
#include "xml.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace judge {
namespace {

namespace fs = std::filesystem;

/// Half the distance of 1 to the next double.
constexpr Real unit_roundoff = 0x1p-53L;

struct Placement {
    Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, offset; ///< images of the axes
    bool turned = false;

    Point apply(const Point& p) const { return p.x * x + p.y * y + p.z * z + offset; }
};

Point vector_of(const std::string& text, const Point& otherwise) {
    if (text.empty()) {
        return otherwise;
    }
    const std::vector<double> v = numbers_of(text);
    return {v.at(0), v.at(1), v.at(2)};
}

/// The frame of <origin>: turned about x, then y, then z of the link (URDF: fixed-axis roll, pitch, yaw).
Placement placement_of(const Element& element) {
    Placement place;
    const Element* origin = element.child("origin");
    if (!origin) {
        return place;
    }
    place.offset = vector_of(origin->attribute("xyz"), {});
    const Point rpy = vector_of(origin->attribute("rpy"), {});
    place.turned = rpy.x != 0 || rpy.y != 0 || rpy.z != 0;
    const Real cr = std::cos(rpy.x), sr = std::sin(rpy.x), cp = std::cos(rpy.y), sp = std::sin(rpy.y),
               cy = std::cos(rpy.z), sy = std::sin(rpy.z);
    place.x = {cy * cp, sy * cp, -sp};
    place.y = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr};
    place.z = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr};
    return place;
}

/// What doubles lose when a point p of size |p| is scaled, turned and moved by t, each coordinate, in unit roundoffs:
/// an entry of the rotation is a sum of two products of sines, each within 1: four; its product with a coordinate, and
/// the sum of three: another three; so seven of |x| + |y| + |z| <= sqrt(3) |p|, over three coordinates: 3 * 7 = 21 of
/// |p|. A scale: one of |p|. The offset: one of |p| + |t|. What is neither turned, scaled nor moved loses nothing.
Real placement_error(const Placement& place, bool scaled, Real size) {
    const bool moved = place.offset.x != 0 || place.offset.y != 0 || place.offset.z != 0;
    Real error = place.turned ? 21 * size : 0;
    error += scaled ? 2 * size : 0;
    error += moved ? 2 * (size + length(place.offset)) : 0;
    return unit_roundoff * error;
}

Real size_of(const std::vector<Corners>& triangles) {
    Real size = 0;
    for (const Corners& corners : triangles) {
        for (const Point& p : corners) {
            size = std::max(size, length(p));
        }
    }
    return size;
}

Part placed(std::vector<Corners> triangles, const Placement& place, const Point& scale) {
    const bool scaled = scale.x != 1 || scale.y != 1 || scale.z != 1;
    for (Corners& corners : triangles) {
        for (Point& p : corners) {
            p = {p.x * scale.x, p.y * scale.y, p.z * scale.z};
        }
    }
    Part part;
    part.rounding = placement_error(place, scaled, size_of(triangles));
    for (Corners& corners : triangles) {
        for (Point& p : corners) {
            p = place.apply(p);
        }
    }
    part.triangles = std::move(triangles);
    return part;
}

std::vector<Corners> box(const Point& size) {
    const auto corner = [&](unsigned bits) {
        const auto side = [](bool far, Real edge) { return far ? edge / 2 : -edge / 2; };
        return Point{side(bits & 1, size.x), side(bits & 2, size.y), side(bits & 4, size.z)};
    };
    constexpr unsigned faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::vector<Corners> triangles;
    for (const auto& face : faces) {
        for (unsigned k = 2; k < 4; ++k) {
            triangles.push_back({corner(face[0]), corner(face[k - 1]), corner(face[k])});
        }
    }
    return triangles;
}

Part round_part(const Element& shape, const Placement& place) {
    Part part;
    part.kind = shape.name == "sphere"     ? Part::Kind::sphere
                : shape.name == "cylinder" ? Part::Kind::cylinder
                                           : Part::Kind::capsule;
    part.radius = numbers_of(shape.attribute("radius")).at(0);
    part.length = part.kind == Part::Kind::sphere ? 0 : numbers_of(shape.attribute("length")).at(0);
    part.center = place.offset;
    part.across = place.x;
    part.up = place.y;
    part.axis = place.z;
    part.rounding = placement_error(place, false, part.radius + part.length);
    return part;
}

/// "package://NAME/REST" lies in a folder NAME around the URDF, or in the folder NAME of one of those; some files mean
/// a path from a folder around the URDF.
fs::path resolved(const std::string& reference, const fs::path& folder) {
    const std::string scheme = "package://";
    std::string rest = reference.starts_with(scheme) ? reference.substr(scheme.size()) : reference;
    if (rest.starts_with("file://")) {
        rest = rest.substr(7);
    }
    for (fs::path around = fs::absolute(folder);; around = around.parent_path()) {
        if (fs::is_regular_file(around / rest)) {
            return around / rest;
        }
        if (around == around.parent_path()) {
            throw std::runtime_error(reference + ": not found from " + folder.string());
        }
    }
}

Part part_of(const Element& collision, const fs::path& folder) {
    const Placement place = placement_of(collision);
    const Element& shape = collision.at("geometry").children.at(0);
    if (shape.name == "mesh") {
        return placed(read_triangles(resolved(shape.attribute("filename"), folder)), place,
                      vector_of(shape.attribute("scale"), {1, 1, 1}));
    }
    if (shape.name == "box") {
        return placed(box(vector_of(shape.attribute("size"), {})), place, {1, 1, 1});
    }
    return round_part(shape, place);
}

std::vector<Link> read_urdf(const fs::path& file, const std::set<std::string>& without = {}) {
    std::vector<Link> links;
    for (const Element& element : parse_xml(bytes_of(file)).children) {
        if (element.name != "link" || without.contains(element.attribute("name"))) {
            continue;
        }
        Link link{element.attribute("name"), {}};
        for (const Element& child : element.children) {
            if (child.name == "collision") {
                link.parts.push_back(part_of(child, file.parent_path()));
            }
        }
        if (!link.parts.empty()) {
            links.push_back(std::move(link));
        }
    }
    return links;
}

/// Fields of a line of RFC 4180; `stream` gives further lines where a field goes on.
std::vector<std::string> fields_of(std::istream& stream) {
    std::vector<std::string> fields;
    std::string field;
    bool quoted = false, any = false;
    for (int c = stream.get(); c != EOF; c = stream.get()) {
        any = true;
        if (c == '"') {
            if (quoted && stream.peek() == '"') {
                field += static_cast<char>(stream.get());
            } else {
                quoted = !quoted;
            }
        } else if (!quoted && c == ',') {
            fields.push_back(std::move(field));
            field.clear();
        } else if (!quoted && c == '\n') {
            break;
        } else if (quoted || c != '\r') {
            field += static_cast<char>(c);
        }
    }
    if (any) {
        fields.push_back(std::move(field));
    }
    return fields;
}

std::map<std::string, std::vector<Ball>> read_csv(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<std::string> head = fields_of(stream);
    const auto column = [&](const char* name) {
        const auto found = std::find(head.begin(), head.end(), name);
        if (found == head.end()) {
            throw std::runtime_error(file.string() + ": no column " + name);
        }
        return static_cast<std::size_t>(found - head.begin());
    };
    const std::size_t link = column("link"), x = column("x"), y = column("y"), z = column("z"), r = column("radius");
    std::map<std::string, std::vector<Ball>> spheres;
    for (std::vector<std::string> row = fields_of(stream); !row.empty(); row = fields_of(stream)) {
        const auto number = [&](std::size_t i) { return static_cast<Real>(numbers_of(row.at(i)).at(0)); };
        spheres[row.at(link)].push_back({{number(x), number(y), number(z)}, number(r)});
    }
    return spheres;
}

} // namespace

std::vector<Link> read_original(const fs::path& file) {
    return is_mesh(file) ? std::vector<Link>{{"", {placed(read_triangles(file), {}, {1, 1, 1})}}} : read_urdf(file);
}

std::map<std::string, std::vector<Ball>> read_spheres(const fs::path& file, const std::set<std::string>& without) {
    if (file.extension() == ".csv") {
        return read_csv(file);
    }
    std::map<std::string, std::vector<Ball>> spheres;
    for (const Link& link : read_urdf(file, without)) {
        for (const Part& part : link.parts) {
            if (part.kind != Part::Kind::sphere) {
                throw std::runtime_error(file.string() + ": link '" + link.name + "' has geometry that is no sphere");
            }
            spheres[link.name].push_back({part.center, part.radius});
        }
    }
    return spheres;
}

} // namespace judge
