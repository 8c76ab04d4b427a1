#include "model.hpp"

#include "json.hpp"
#include "judge.hpp"
#include "mesh_files.hpp"
#include "pose.hpp"
#include "urdf.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace judge {
namespace {

using Elements = std::map<std::string, std::vector<Body>>;

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

Elements elements_of_csv(const std::filesystem::path& file) {
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
    Elements elements;
    for (std::vector<std::string> row = fields_of(stream); !row.empty(); row = fields_of(stream)) {
        const auto number = [&](std::size_t i) { return static_cast<Real>(numbers_of(row.at(i)).at(0)); };
        elements[row.at(link)].push_back(ball_at({number(x), number(y), number(z)}, number(r)));
    }
    return elements;
}

/// The hull of a mesh that is one itself: closed, with every triangle on the hull's surface, to a billionth of its
/// size.
Body convex_mesh(const std::vector<Corners>& triangles) {
    std::vector<Point> corners;
    for (const Corners& triangle : triangles) {
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    Body hull = hull_of(corners);
    const bool convex = std::all_of(triangles.begin(), triangles.end(), [&](const Corners& c) {
        const Point middle = 1 / Real{3} * (c[0] + c[1] + c[2]);
        return depth(hull, middle, std::numeric_limits<Real>::infinity()) > -1e-9L * hull.reach;
    });
    if (!convex || !plain(triangles)) {
        throw std::runtime_error(convex ? "it is not closed" : "it is not convex");
    }
    return hull;
}

Body mesh_element(const Element& shape, const Placement& place, const std::filesystem::path& folder) {
    const std::string name = shape.attribute("filename");
    std::vector<Corners> triangles = read_triangles(resolved(name, folder));
    const Point scale = vector_of(shape.attribute("scale"), {1, 1, 1});
    for (Corners& corners : triangles) {
        for (Point& p : corners) {
            p = place.apply({p.x * scale.x, p.y * scale.y, p.z * scale.z});
        }
    }
    try {
        return convex_mesh(triangles);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

Body element_of(const Element& collision, const std::filesystem::path& folder) {
    const Placement place = placement_of(collision);
    const Element& shape = collision.at("geometry").children.at(0);
    const auto number = [&](const char* name) { return static_cast<Real>(numbers_of(shape.attribute(name)).at(0)); };
    if (shape.name == "sphere") {
        return ball_at(place.offset, number("radius"));
    }
    if (shape.name == "box") {
        return rounded_box(place, 0.5L * vector_of(shape.attribute("size"), {}), 0);
    }
    if (shape.name == "cylinder") {
        return cylinder(place, number("length") / 2, number("radius"));
    }
    if (shape.name == "capsule") { // with or without Drake's namespace
        return rounded_box(place, {0, 0, number("length") / 2}, number("radius"));
    }
    if (shape.name == "mesh") {
        return mesh_element(shape, place, folder);
    }
    throw std::runtime_error("the judge does not know the element <" + shape.name + ">");
}

Elements elements_of_urdf(const std::filesystem::path& file, const std::set<std::string>& without) {
    Elements elements;
    for (const LinkCollisions& link : collisions_of(file, without)) {
        for (const Element& collision : link.collisions) {
            elements[link.link].push_back(element_of(collision, file.parent_path()));
        }
    }
    return elements;
}

/// p of the element is at rotation * p + position: the columns of the rotation are the axes.
Placement placement_of(const Json& element) {
    Placement place;
    place.offset = element.at("position").point();
    if (element.members.contains("rotation")) {
        const std::vector<Json>& rows = element.list("rotation");
        const Point a = rows.at(0).point(), b = rows.at(1).point(), c = rows.at(2).point();
        place = {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, place.offset, true};
    }
    return place;
}

Body element_of(const Json& element) {
    const Placement place = placement_of(element);
    const std::string& kind = element.at("kind").text;
    if (kind == "hull") {
        std::vector<Point> vertices;
        for (const Json& vertex : element.at("vertices").items) {
            vertices.push_back(place.apply(vertex.point()));
        }
        return hull_of(vertices);
    }
    if (kind == "box" || kind == "swept_box") {
        const Real radius = kind == "box" ? 0 : element.at("radius").number;
        return rounded_box(place, 0.5L * element.at("size").point(), radius);
    }
    if (kind == "sphere") {
        return ball_at(place.offset, element.at("radius").number);
    }
    const Real half = static_cast<Real>(element.at("length").number) / 2, radius = element.at("radius").number;
    if (kind != "capsule" && kind != "cylinder") {
        throw std::runtime_error("the judge does not know the element " + kind);
    }
    return kind == "capsule" ? rounded_box(place, {0, 0, half}, radius) : cylinder(place, half, radius);
}

Elements elements_of_json(const std::filesystem::path& file) {
    Elements elements;
    const Json document = parse_json(bytes_of(file));
    for (const auto& [name, link] : document.at("links").members) {
        for (const Json& s : link.list("spheres")) {
            const auto number = [&](std::size_t i) { return static_cast<Real>(s.items.at(i).number); };
            elements[name].push_back(ball_at({number(0), number(1), number(2)}, number(3)));
        }
        for (const Json& element : link.list("elements")) {
            elements[name].push_back(element_of(element));
        }
    }
    return elements;
}

} // namespace

Elements read_elements(const std::filesystem::path& file, const std::set<std::string>& without) {
    return file.extension() == ".csv"    ? elements_of_csv(file)
           : file.extension() == ".json" ? elements_of_json(file)
                                         : elements_of_urdf(file, without);
}

std::map<std::string, std::vector<Ball>> read_spheres(const std::filesystem::path& file,
                                                      const std::set<std::string>& without) {
    std::map<std::string, std::vector<Ball>> spheres;
    for (const auto& [link, elements] : read_elements(file, without)) {
        for (const Body& element : elements) {
            if (element.kind != Body::Kind::ball) {
                throw std::runtime_error(file.string() + ": link '" + link + "' has geometry that is no sphere");
            }
            spheres[link].push_back({element.place.offset, element.radius});
        }
    }
    return spheres;
}

} // namespace judge
